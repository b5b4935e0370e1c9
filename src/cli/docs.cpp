// SPDX-License-Identifier: GPL-3.0-or-later
#include <iostream>
#include <memory>
#include <string>

#include "commands.h"
#include "palpate/io/case.h"
#include "palpate/sim/scene.h"

namespace palpate::cli {

void addDocs(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand(
      "docs", "Print a page of documentation that is generated from the program");
  const auto page = std::make_shared<std::string>();
  command
      ->add_option("page", *page,
                   "scene_format: keys of scene files; case_format: keys of case files")
      ->required()
      ->check(CLI::IsMember({"scene_format", "case_format"}));
  command->callback([page, &action] {
    action = [page] {
      std::cout << (*page == "scene_format" ? sim::sceneFormatMarkdown()
                                            : io::caseFormatMarkdown());
      return kOk;
    };
  });
}

}  // namespace palpate::cli
