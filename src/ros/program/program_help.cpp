// SPDX-License-Identifier: GPL-3.0-or-later
#include "program_help.h"

#include <ros/init.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iomanip>
#include <sstream>

#include "program.h"

namespace palpate::node {
namespace {

void addRows(std::ostream& out, const std::string& heading, const std::vector<About::Row>& rows) {
  if (rows.empty()) return;
  std::size_t names = 0, types = 0;
  for (const About::Row& row : rows) {
    names = std::max(names, row.name.size());
    types = std::max(types, row.type.size());
  }
  out << '\n' << heading << ":\n" << std::left;
  for (const About::Row& row : rows) {
    out << "  " << std::setw(static_cast<int>(names)) << row.name << "  "
        << std::setw(static_cast<int>(types)) << row.type << "  " << row.what << '\n';
  }
}

}  // namespace

std::string graphHelp(const About& about) {
  std::ostringstream out;
  const std::string params = about.params.table();
  if (!params.empty()) {
    out << "\nParameters and their defaults, on the command line _name:=value:\n" << params;
  }
  addRows(out, "Topics heard", about.hears);
  addRows(out, "Topics published", about.says);
  addRows(out, "Services", about.serves);
  return out.str();
}

std::optional<int> answerOptions(int argc, char** argv, const About& about) {
  std::vector<std::string> arguments;
  ros::removeROSArgs(argc, argv, arguments);
  std::reverse(arguments.begin(), arguments.end());  // as CLI11 wants them
  if (!arguments.empty()) arguments.pop_back();      // the program
  CLI::App app(about.what, about.program);
  app.footer(graphHelp(about));
  try {
    app.parse(arguments);
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? 0 : kBadInput;
  }
  return std::nullopt;
}

}  // namespace palpate::node
