// SPDX-License-Identifier: GPL-3.0-or-later
#include "palpate/analysis/case.h"

#include "case_fields.h"
#include "palpate/keys/markdown_writer.h"
#include "palpate/keys/yaml_reader.h"

namespace palpate::analysis {

Case readCase(const std::string& file) {
  Case c;
  c.file = file;
  keys::readYaml(file, [&](keys::FieldVisitor& v) { describe(v, c); });
  return c;
}

std::string caseFormatMarkdown() {
  Case defaults;
  return "# Case files of `palpate solve`\n\n"
         "A case is a YAML file that says what a body is made of, what is done to it and what is\n"
         "to be known about it afterwards. Units are SI. This page is generated from the list of\n"
         "keys that reads and checks the files:\n\n"
         "    palpate docs case_format > docs/case_format.md\n\n"
         "Every key is optional unless it says **required**. A key that is not listed here, a "
         "value\n"
         "of another type or outside its range, or a broken rule is refused with all other "
         "problems\n"
         "of the file.\n" +
         keys::fieldsMarkdown([&](keys::FieldVisitor& v) { describe(v, defaults); });
}

}  // namespace palpate::analysis
