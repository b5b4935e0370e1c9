// SPDX-License-Identifier: GPL-3.0-or-later
#include "sha256.h"

#include <openssl/evp.h>

#include <array>
#include <fstream>
#include <memory>

namespace palpate::node {

std::string sha256OfFile(const std::string& file) {
  const std::unique_ptr<EVP_MD_CTX, void (*)(EVP_MD_CTX*)> context(EVP_MD_CTX_new(),
                                                                   EVP_MD_CTX_free);
  std::ifstream in(file, std::ios::binary);
  if (!in || !context || EVP_DigestInit_ex(context.get(), EVP_sha256(), nullptr) != 1) return "";
  std::array<char, 65536> part;
  do {
    in.read(part.data(), part.size());
    if (EVP_DigestUpdate(context.get(), part.data(), static_cast<std::size_t>(in.gcount())) != 1) {
      return "";
    }
  } while (in);
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest;
  unsigned int size = 0;
  if (!in.eof() || EVP_DigestFinal_ex(context.get(), digest.data(), &size) != 1) return "";
  std::string text;
  for (unsigned int k = 0; k < size; ++k) {
    constexpr char kDigits[] = "0123456789abcdef";
    text += {kDigits[digest[k] >> 4], kDigits[digest[k] & 15]};
  }
  return text;
}

}  // namespace palpate::node
