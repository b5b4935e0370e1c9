// SPDX-License-Identifier: GPL-3.0-or-later
// palpate_models PART [--quick]: the figures of a part of docs/results/models.md, as JSON.
#include <exception>
#include <iostream>
#include <map>
#include <string>

#include "parts.h"

int main(int count, char** arguments) {
  using Part = std::string (*)(bool);
  const std::map<std::string, Part> parts = {{"beams", palpate::models::beams},
                                             {"boundary", palpate::models::boundary},
                                             {"directions", palpate::models::directions},
                                             {"discs", palpate::models::discs},
                                             {"ends", palpate::models::ends},
                                             {"enriched", palpate::models::enriched},
                                             {"free_sheet", palpate::models::freeSheet},
                                             {"hung_cloth", palpate::models::hungCloth},
                                             {"ideal", palpate::models::ideal},
                                             {"plates", palpate::models::plates},
                                             {"solids", palpate::models::solids},
                                             {"tracking", palpate::models::tracking},
                                             {"unrolling", palpate::models::unrolling}};
  const auto part = count > 1 ? parts.find(arguments[1]) : parts.end();
  const bool quick = count > 2 && std::string(arguments[2]) == "--quick";
  if (part == parts.end() || count > 3 || (count == 3 && !quick)) {
    std::cerr << "palpate_models PART [--quick]; parts:";
    for (const auto& [name, run] : parts) std::cerr << " " << name;
    std::cerr << "\n";
    return 2;
  }
  try {
    std::cout << part->second(quick) << "\n";
  } catch (const std::exception& error) {
    std::cerr << "palpate_models " << part->first << ": " << error.what() << "\n";
    return 1;
  }
  return 0;
}
