// SPDX-License-Identifier: GPL-3.0-or-later
#include "model_library.h"

#include <dlfcn.h>

#include <filesystem>
#include <stdexcept>

namespace palpate::tissue {
namespace {

// Folder of the library with this function, or of the program.
std::filesystem::path ownFolder() {
  Dl_info info{};
  const auto here = reinterpret_cast<const void*>(&makerInLibrary);
  if (::dladdr(here, &info) == 0 || !info.dli_fname) return {};
  std::error_code error;
  const std::filesystem::path file = std::filesystem::canonical(info.dli_fname, error);
  return error ? std::filesystem::path() : file.parent_path();
}

}  // namespace

ModelMaker makerInLibrary(const std::string& name) {
  const std::string symbol = "palpate_model_" + name, file = "lib" + symbol + ".so";
  // The symbol exists already in a program that links the library.
  const void* maker = ::dlsym(RTLD_DEFAULT, symbol.c_str());
  if (!maker) {
    constexpr int kFlags = RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE;
    const std::string own = (ownFolder() / file).string();
    void* library = ::dlopen(own.c_str(), kFlags);
    std::string problem;
    if (!library) {
      problem = ::dlerror();
      library = ::dlopen(file.c_str(), kFlags);
    }
    if (!library) {
      throw std::invalid_argument("model = " + name + " is in the library " + file + " (target " +
                                  symbol + "), which cannot be loaded: " + problem);
    }
    maker = ::dlsym(library, symbol.c_str());
    if (!maker) throw std::invalid_argument("model = " + name + " is not in " + file);
  }
  return *static_cast<const ModelMaker*>(maker);
}

}  // namespace palpate::tissue
