#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/number_text.hpp"
#include "case/nearest.hpp"
#include "case/writer.hpp"
#include "report/html.hpp"
#include "report/page.hpp"

namespace breccia::report {
namespace {

using case_::WrittenKey;

/// Equal entries of a list of the case for several groups, or pairs of groups.
struct Column {
  std::vector<std::string> groups;
  std::vector<WrittenKey> keys;
};

bool names_groups(const WrittenKey& written) {
  return written.key->name() == "group" || written.key->name() == "between";
}

bool same(const WrittenKey& a, const WrittenKey& b) { return a.key == b.key && a.value == b.value; }

std::string name_of(const std::string& group) { return group == case_::every_group ? "any" : group; }

std::string name_of(const std::array<std::string, 2>& groups) {
  return groups[0] == groups[1] && groups[0] != case_::every_group ? groups[0]
                                                                   : name_of(groups[0]) + " – " + name_of(groups[1]);
}

void add(std::vector<Column>& columns, const std::string& group, std::vector<WrittenKey> keys) {
  keys.erase(std::remove_if(keys.begin(), keys.end(), names_groups), keys.end());
  const auto found = std::find_if(columns.begin(), columns.end(), [&](const Column& column) {
    return std::equal(column.keys.begin(), column.keys.end(), keys.begin(), keys.end(), same);
  });
  if (found != columns.end())
    found->groups.push_back(group);
  else
    columns.push_back({{group}, std::move(keys)});
}

/// With ten digits where three do not give the value, or where the unit has a prefix already.
Cell number_cell(double value, std::string_view unit) {
  const bool short_enough = std::abs(rounded(value, 3) - value) <= 1e-12 * std::abs(value);
  if (short_enough && !unit.starts_with("kg")) return Cell::number_of(value, unit);
  return {
      fmt::format("<data value=\"{:.17g}\">{:.10g}{}{}</data>", value, value, unit.empty() ? "" : " ", escaped(unit)),
      true};
}

/// A value without the marks of TOML.
Cell cell_of(const WrittenKey& written) {
  const std::string_view unit = written.key->unit;
  if (written.number) return number_cell(*written.number, unit == "1" ? "" : unit);
  const std::string& value = written.value;
  const bool quoted = value.size() > 1 && value.front() == '"' && value.back() == '"';
  return {escaped(quoted ? value.substr(1, value.size() - 2) : value), true};
}

/// The keys of all columns, each once, in the order of the case file.
std::vector<const case_::Key*> keys_of(const std::vector<Column>& columns) {
  std::vector<const case_::Key*> keys;
  for (const Column& column : columns) {
    for (const WrittenKey& written : column.keys) {
      if (std::find(keys.begin(), keys.end(), written.key) == keys.end()) keys.push_back(written.key);
    }
  }
  std::sort(keys.begin(), keys.end());  // they are rows of one table
  return keys;
}

/// Keys by groups; a column for what several groups have in common.
std::string table_of(const char* caption, const std::vector<Column>& columns) {
  Table table{caption, {"key"}, {}};
  for (const Column& column : columns) table.heads.push_back(case_::joined(column.groups));
  for (const case_::Key* key : keys_of(columns)) {
    std::vector<Cell>& row = table.rows.emplace_back();
    row.push_back(Cell::text(key->path.substr(key->path.find("[].") + 3)));  // "softening.kind"
    for (const Column& column : columns) {
      const auto found = std::find_if(column.keys.begin(), column.keys.end(),
                                      [&](const WrittenKey& written) { return written.key == key; });
      row.push_back(found == column.keys.end() ? Cell{"–", true} : cell_of(*found));
    }
  }
  return table.html();
}

}  // namespace

std::string model(const RunRecord& run) {
  std::vector<Column> materials, joints, contacts;
  for (const case_::Material& material : run.materials) add(materials, name_of(material.group), written_keys(material));
  for (const case_::Joint& joint : run.joints) add(joints, name_of(joint.groups), written_keys(joint));
  for (const case_::Contact& contact : run.contacts) add(contacts, name_of(contact.groups), written_keys(contact));
  return tables(table_of("Materials", materials) + table_of("Joints", joints) + table_of("Contacts", contacts));
}

}  // namespace breccia::report
