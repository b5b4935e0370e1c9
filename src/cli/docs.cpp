// SPDX-License-Identifier: GPL-3.0-or-later
#include <filesystem>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>

#include "command.h"
#include "commands.h"
#include "palpate/analysis/case.h"
#include "palpate/base/error.h"
#include "palpate/base/resource.h"
#include "palpate/haptics/device_models.h"
#include "palpate/scene/scene.h"
#include "palpate/scene/tissue_file.h"

namespace palpate::cli {
namespace {

std::string textOf(const std::string& page) {
  if (page == "scene_format") return scene::sceneFormatMarkdown();
  if (page == "case_format") return analysis::caseFormatMarkdown();
  if (page == "devices") return haptics::devicesMarkdown();
  const std::string folder = "package://palpate/config/materials";
  try {
    return scene::tissuesMarkdown(
        resolveResource(folder, std::filesystem::current_path().string()));
  } catch (const std::invalid_argument& error) {
    throw InputError(folder, "", "", error.what());
  }
}

}  // namespace

void addDocs(CLI::App& app, Action& action) {
  Command command(app, "docs", "Print a page of documentation that is generated from the program");
  const auto page = std::make_shared<std::string>();
  command
      .option("page", page.get(),
              "scene_format: keys of scene files; case_format: keys of case files; tissues: the "
              "materials in config/materials; devices: haptic devices and their limits")
      .required()
      .oneOf({"scene_format", "case_format", "tissues", "devices"});
  command.onUse([page, &action] {
    action = [page] {
      std::cout << textOf(*page);
      return kOk;
    };
  });
}

}  // namespace palpate::cli
