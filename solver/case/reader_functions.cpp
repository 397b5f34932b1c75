#include <algorithm>

#include "case/nearest.hpp"
#include "case/reader_values.hpp"

// Functions of time: the rows of the schema below <function>.

namespace breccia::case_ {
namespace {

using Points = std::vector<TimeFunction::Point>;

const std::string prefix = "<function>.";

// A row of the schema with the unit of the value it stands in. Owns the unit's text.
struct RowOf {
  std::string unit;
  Key row;

  RowOf(const Key& key, std::string_view name) : row(key_of(prefix + std::string(name))) {
    unit = row.unit;
    if (const std::size_t star = unit.find('*'); star != std::string::npos) unit.replace(star, 1, key.unit);
    row.unit = unit;
  }
  RowOf(const RowOf&) = delete;
  RowOf& operator=(const RowOf&) = delete;
};

// Sum of two piecewise linear functions: straight between the times of both.
Points sum(const Points& a, const Points& b) {
  if (a.empty() || b.empty()) return a.empty() ? b : a;
  TimeFunction fa, fb;
  fa.table = a;
  fb.table = b;
  std::vector<double> times;
  for (const auto& p : a) times.push_back(p.time);
  for (const auto& p : b) times.push_back(p.time);
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  Points out;
  for (const double t : times) out.push_back({t, fa(t) + fb(t)});
  return out;
}

// Sum of many, pair by pair and then pairs of pairs, so that N of them cost N log N.
Points sum(std::vector<Points> parts) {
  for (std::size_t step = 1; step < parts.size(); step *= 2) {
    for (std::size_t i = 0; i + step < parts.size(); i += 2 * step) parts[i] = sum(parts[i], parts[i + step]);
  }
  return parts.empty() ? Points{} : std::move(parts.front());
}

}  // namespace

void ValueReader::read(const Key& key, const Node& node, const std::string& path, TimeFunction& out) {
  TimeFunction f;
  const std::size_t before = problems_.size();
  if (node.is(Node::Kind::table)) {
    function_table(key, node, path, f);
  } else if (node.is(Node::Kind::list) || node.is(Node::Kind::boolean) || node.is(Node::Kind::other)) {
    wrong_type(key, node, path);
  } else {
    number(key, node, path, f.constant);
  }
  if (problems_.size() == before) out = std::move(f);
}

void ValueReader::function_table(const Key& key, const Node& table, const std::string& path, TimeFunction& out) {
  for (const auto& [name, value] : table.entries) {
    const std::vector<std::string> names = names_in("<function>");
    if (std::find(names.begin(), names.end(), name) == names.end())
      unknown_key(value, path + "." + name, prefix + name);
  }
  if (table.entries.empty()) problem(table, path, "is an empty table", allowed_text(key), "");
  out.constant = function_part(key, table, path, "constant");
  out.linear = function_part(key, table, path, "linear");
  std::vector<Points> parts;
  if (const Node* points = table.find("table")) parts.push_back(function_points(key, *points, path + ".table"));
  if (const Node* ramps = table.find("ramp"))
    for (const Node* ramp : function_tables(*ramps, path + ".ramp", "ramp[]"))
      parts.push_back(function_ramp(key, *ramp, path + ".ramp"));
  if (const Node* files = table.find("csv"))
    for (const Node* file : function_tables(*files, path + ".csv", "csv[]"))
      parts.push_back(function_csv(key, *file, path + ".csv"));
  out.table = sum(std::move(parts));
  if (const Node* sines = table.find("sine"))
    for (const Node* sine : function_tables(*sines, path + ".sine", "sine[]"))
      out.sines.push_back({.amplitude = function_part(key, *sine, path + ".sine", "sine[].amplitude"),
                           .frequency = function_part(key, *sine, path + ".sine", "sine[].frequency"),
                           .phase = function_part(key, *sine, path + ".sine", "sine[].phase")});
}

double ValueReader::function_part(const Key& key, const Node& table, const std::string& path, std::string_view row) {
  const RowOf of(key, row);
  const std::string own = path + "." + std::string(of.row.name());
  double value = 0;
  if (const Node* node = table.find(of.row.name())) {
    number(of.row, *node, own, value);
  } else if (of.row.required) {
    missing_key(of.row, table, own);
  } else {
    const Node fallback = parse_toml_value(of.row.fallback, "schema");
    number(of.row, fallback, own, value);
  }
  return value;
}

std::vector<const Node*> ValueReader::function_tables(const Node& node, const std::string& path, std::string_view row) {
  const std::string pattern = prefix + std::string(row);
  std::vector<const Node*> tables;
  if (node.is(Node::Kind::table)) tables.push_back(&node);
  if (node.is(Node::Kind::list))
    for (const Node& item : node.items) tables.push_back(&item);
  const bool all_tables =
      std::all_of(tables.begin(), tables.end(), [](const Node* n) { return n->is(Node::Kind::table); });
  if (tables.empty() || !all_tables) {
    problem(node, path, "is " + std::string(node.kind_name()),
            "a table of " + joined(names_in(pattern)) + ", or a list of them", node.shown());
    return {};
  }
  for (const Node* table : tables)
    for (const auto& [name, value] : table->entries)
      if (find_key(pattern + "." + name) == nullptr) unknown_key(value, path + "." + name, pattern + "." + name);
  return tables;
}

Points ValueReader::function_ramp(const Key& key, const Node& node, const std::string& path) {
  const std::size_t before = problems_.size();
  const TimeFunction::Point first{function_part(key, node, path, "ramp[].start"),
                                  function_part(key, node, path, "ramp[].from")};
  const TimeFunction::Point last{function_part(key, node, path, "ramp[].end"),
                                 function_part(key, node, path, "ramp[].to")};
  if (problems_.size() == before && !(last.time > first.time))
    problem(node, path, "does not end after its start", "end > start", node.shown());
  return {first, last};
}

template <class T>
bool ValueReader::function_row(const Key& row, const Node& table, const std::string& path, T& out) {
  const std::string own = path + "." + std::string(row.name());
  const std::size_t before = problems_.size();
  if (const Node* node = table.find(row.name()))
    read(row, *node, own, out);
  else if (row.required)
    missing_key(row, table, own);
  else
    read(row, parse_toml_value(row.fallback, "schema"), own, out);
  return problems_.size() == before;
}

/// The points of a file, in the unit of the key.
Points ValueReader::function_csv(const Key& key, const Node& node, const std::string& path) {
  PointFile source;
  source.si_unit = key.unit;
  const auto row = [](const char* name) { return key_of(prefix + "csv[]." + name); };
  const bool read =
      function_row(row("file"), node, path, source.file) & function_row(row("time"), node, path, source.time) &
      function_row(row("value"), node, path, source.value) &
      function_row(row("time_unit"), node, path, source.time.unit) &
      function_row(row("value_unit"), node, path, source.value.unit) &
      function_row(row("scale"), node, path, source.scale) & function_row(row("start"), node, path, source.start);
  if (!read) return {};
  Points points;
  try {
    points = read_points(source);
  } catch (const InputError& error) {
    for (Problem wrong : error.problems()) {
      // What is wrong with the file as a whole is wrong with its name in the case.
      if (wrong.line == 0)
        problem(*node.find("file"), path + ".file", wrong.what, wrong.allowed, source.file.string());
      else
        problems_.push_back({wrong.file, wrong.line, path, wrong.what, wrong.allowed, wrong.given});
    }
    return {};
  }
  num_points_ += points.size();
  if (num_points_ > kMostPointsOfCase) {
    problem(node, path, "the files of the case have too many lines in all",
            "at most " + std::to_string(kMostPointsOfCase) + ", a file that several groups share counted for each", "");
    return {};
  }
  const auto by_value = [](const TimeFunction::Point& a, const TimeFunction::Point& b) { return a.value < b.value; };
  const auto [least, largest] = std::minmax_element(points.begin(), points.end(), by_value);
  data_.files.push_back({source.file, path.substr(0, path.rfind('.')), source.si_unit, points.front(), points.back(),
                         least->value, largest->value, points.size()});
  return points;
}

Points ValueReader::function_points(const Key& key, const Node& node, const std::string& path) {
  const RowOf of(key, "table");
  Key time = of.row;
  time.unit = key_of(prefix + "ramp[].start").unit;
  if (!node.is(Node::Kind::list)) {
    wrong_type(of.row, node, path);
    return {};
  }
  if (node.items.empty()) problem(node, path, "has no points", allowed_text(of.row), node.shown());
  Points out;
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    const Node& item = node.items[i];
    const std::string own = indexed(path, i);
    if (!item.is(Node::Kind::list) || item.items.size() != 2) {
      problem(item, own, "is no point", "[time, value]", item.shown());
      continue;
    }
    TimeFunction::Point p;
    const bool both =
        number(time, item.items[0], own + "[0]", p.time) & number(of.row, item.items[1], own + "[1]", p.value);
    if (!both) continue;
    if (!out.empty() && !(p.time > out.back().time))
      problem(item, own, "its time is not later than that of the point before", "times increasing", item.shown());
    out.push_back(p);
  }
  return out;
}

void ValueReader::read_axes(const Key& key, const Node& node, const std::string& path, std::array<bool, 3>& axes,
                            std::array<TimeFunction, 3>& out) {
  if (!node.is(Node::Kind::table)) return wrong_type(key, node, path);
  if (node.entries.empty()) problem(node, path, "names no axis", allowed_text(key), node.shown());
  for (const auto& [name, value] : node.entries) {
    const std::size_t axis = name.size() == 1 ? std::string_view("xyz").find(name) : std::string_view::npos;
    if (axis == std::string_view::npos) {
      problem(value, path + "." + name, "is no axis", allowed_text(key), "");
      continue;
    }
    axes[axis] = true;
    read(key, value, path + "." + name, out[axis]);
  }
}

}  // namespace breccia::case_
