#include "report/figures.hpp"

#include <cmath>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "output/folder/json_text.hpp"
#include "report/html.hpp"

namespace breccia::report {
namespace {

using nlohmann::json;

std::vector<double> numbers_in(const json& node) {
  std::vector<double> values;
  if (node.is_number()) values.push_back(node.get<double>());
  if (node.is_array()) {
    for (const json& value : node) values.push_back(value.is_number() ? value.get<double>() : kNoNumber);
  }
  return values;
}

std::string text_in(const json& object, const char* name) {
  const auto found = object.find(name);
  return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

double number_in(const json& object, const char* name) {
  const auto found = object.find(name);
  return found != object.end() && found->is_number() ? found->get<double>() : 0;
}

/// Its entries; none where it is no list.
json list_in(const json& object, const char* name) {
  const auto found = object.find(name);
  return found != object.end() && found->is_array() ? *found : json::array();
}

Row row_of(const json& object) {
  Row row;
  for (const auto& [name, value] : object.items()) row[name] = numbers_in(value);
  return row;
}

/// Numbers of a part are facts, strings texts, lists of objects tables, objects curves.
void take_part(const std::string& name, const json& part, Figures& figures) {
  for (const auto& [key, value] : part.items()) {
    if (value.is_number()) {
      figures.facts[name][key] = value.get<double>();
    } else if (value.is_string()) {
      figures.texts[name][key] = value.get<std::string>();
    } else if (value.is_array()) {
      std::vector<Row>& table = figures.tables[name + "." + key];
      for (const json& row : value) {
        if (row.is_object()) table.push_back(row_of(row));
      }
    } else if (value.is_object()) {
      figures.curves[name + "." + key] = row_of(value);
    }
  }
}

std::string file_as_base64(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
  return base64(std::as_bytes(std::span(bytes.data(), bytes.size())));
}

void take_picture(const json& entry, const std::filesystem::path& folder, Figures& figures) {
  Picture picture;
  const std::filesystem::path name = text_in(entry, "file");
  if (name.empty() || name != name.filename()) return;
  picture.png = file_as_base64(folder / name);
  picture.title = text_in(entry, "title");
  picture.text = text_in(entry, "text");
  picture.time = number_in(entry, "time");
  if (!picture.png.empty()) figures.pictures.push_back(std::move(picture));
}

}  // namespace

double Figures::fact(const std::string& part, const std::string& name) const {
  const auto facts_of_part = facts.find(part);
  if (facts_of_part == facts.end()) return kNoNumber;
  const auto found = facts_of_part->second.find(name);
  return found == facts_of_part->second.end() ? kNoNumber : found->second;
}

std::string Figures::text(const std::string& part, const std::string& name) const {
  const auto texts_of_part = texts.find(part);
  if (texts_of_part == texts.end()) return {};
  const auto found = texts_of_part->second.find(name);
  return found == texts_of_part->second.end() ? std::string() : found->second;
}

Figures read_figures(const std::filesystem::path& folder) {
  Figures figures;
  const auto content = json_of_file<json>(folder / "figures.json");
  if (!content.is_object()) return figures;
  for (const auto& [name, value] : content.items()) {
    if (value.is_object()) take_part(name, value, figures);
  }
  figures.paraview = text_in(content, "paraview");
  figures.frames = number_in(content, "frames");
  figures.time = number_in(content, "time");
  for (const json& problem : list_in(content, "problems")) {
    if (problem.is_string()) figures.problems.push_back(problem.get<std::string>());
  }
  for (const json& entry : list_in(content, "pictures")) {
    if (entry.is_object()) take_picture(entry, folder, figures);
  }
  return figures;
}

}  // namespace breccia::report
