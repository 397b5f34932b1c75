#include "core/function_edit.hpp"

#include <QMap>
#include <QRegularExpression>
#include <algorithm>

#include "case/reader_values.hpp"
#include "core/case_outline.hpp"
#include "core/conditions.hpp"
#include "core/value_text.hpp"

namespace breccia::gui {
namespace {

using case_::Key;
using case_::Node;
using case_::ValueType;

/// Row of the table of keys of a summand: <function>.linear, <function>.ramp[].
std::string pattern_of_kind(const QString& kind) {
  return "<function>." + kind.toStdString() + (FunctionEdit::may_be_several(kind) ? "[]" : "");
}

/// What stands at a path of a parsed case; nullptr: nothing does.
const Node* node_at(const Node& root, const QString& path) {
  const Node* node = &root;
  for (const QString& part : path.split('.')) {
    if (node == nullptr) return nullptr;
    node = node->find(part.section('[', 0, 0).toStdString());
    for (const QString& index : part.split('[').mid(1)) {
      const auto i = static_cast<std::size_t>(QString(index).remove(']').toInt());
      if (node == nullptr || i >= node->items.size()) return nullptr;
      node = &node->items[i];
    }
  }
  return node;
}

QString with_unit(const QString& number, const QString& unit) {
  bool bare = false;
  (void)QString(number).replace(',', '.').toDouble(&bare);
  return bare && !unit.isEmpty() ? number + " " + unit : number;
}

}  // namespace

/// What the solver's reader makes of the text.
struct FunctionEdit::Reading {
  std::vector<Problem> problems;
  std::array<bool, 3> given{};
  std::array<TimeFunction, 3> functions;
  std::vector<double> ends;
};

FunctionEdit::FunctionEdit(const Document& document, QString path)
    : key_(&case_::key_of(case_::pattern_of(path.toStdString()))),
      path_(std::move(path)),
      file_(document.file().toStdString()),
      places_(document.places()),
      components_(key_->type == ValueType::function ? QStringList{""} : QStringList{"x", "y", "z"}) {}

bool FunctionEdit::takes_functions(const Key& key) {
  using enum ValueType;
  return key.type == function || key.type == function_vector || key.type == axis_functions;
}

bool FunctionEdit::may_be_several(const QString& kind) {
  return case_::find_key("<function>." + kind.toStdString() + "[]") != nullptr;
}

const QStringList& FunctionEdit::kinds() {
  static const QStringList kinds = [] {
    QStringList found;
    for (const std::string& name : case_::names_in("<function>")) found << QString::fromStdString(name);
    return found;
  }();
  return kinds;
}

void FunctionEdit::give_to(Document& document) const {
  document.take_text(places_.text(), QObject::tr("set %1").arg(words_of(path_, places_)));
}

QString FunctionEdit::at(const QString& path) const { return text_of(places_.value(path.toStdString())); }

void FunctionEdit::set(const QString& path, const QString& toml) {
  const std::string own = path.toStdString();
  places_ =
      TomlPlaces(applied(places_.text(), toml.isEmpty() ? places_.remove(own) : places_.set(own, toml.toStdString())));
}

bool FunctionEdit::is_readable() const {
  const QString value = at(path_);
  const std::string own = path_.toStdString();
  const Place* place = places_.find(own);
  const auto is_apart = [&](const Place& other) {  // [stage.pressure.value.ramp]
    return other.kind == Place::Kind::section && other.path.starts_with(own) &&
           (key_->type != ValueType::axis_functions || other.path != own);
  };
  if (std::any_of(places_.all().begin(), places_.all().end(), is_apart)) return false;
  if (value.isEmpty() || key_->type == ValueType::function) return true;
  if (key_->type == ValueType::axis_functions) return place->kind != Place::Kind::value;
  return places_.find(own + "[2]") != nullptr && places_.find(own + "[3]") == nullptr;
}

QString FunctionEdit::component_path(int component) const {
  if (key_->type == ValueType::function) return path_;
  if (key_->type == ValueType::axis_functions) return path_ + "." + components_[component];
  return path_ + QString("[%1]").arg(component);
}

std::vector<FunctionPart> FunctionEdit::parts(int component) const {
  const QString path = component_path(component);
  const Place* place = places_.find(path.toStdString());
  if (place != nullptr && place->kind == Place::Kind::value) return {{"constant", path}};
  std::vector<FunctionPart> found;
  for (const std::string& name : places_.names_below(path.toStdString())) {
    const QString kind = QString::fromStdString(name), own = path + "." + kind;
    const int count = may_be_several(kind) ? places_.count(own.toStdString()) : 0;
    if (!kinds().contains(kind)) continue;
    if (count == 0) found.push_back({kind, own});
    for (int i = 0; i < count; ++i) found.push_back({kind, own + QString("[%1]").arg(i)});
  }
  return found;
}

std::vector<FunctionNumber> FunctionEdit::numbers(const FunctionPart& part) const {
  const std::string pattern = pattern_of_kind(part.kind);
  const auto with = [&](const QString& path, const Key& row) {
    return FunctionNumber{path, &row, text_of(row.unit).replace('*', text_of(key_->unit))};
  };
  if (!may_be_several(part.kind)) return {with(part.path, case_::key_of(pattern))};
  std::vector<FunctionNumber> found;
  for (const Key* row : keys_in(pattern)) found.push_back(with(part.path + "." + text_of(row->name()), *row));
  return found;
}

QString FunctionEdit::value_of(int component) const {
  static const QMap<QString, QString> value_in{{"ramp", "to"}, {"sine", "amplitude"}};
  for (const FunctionPart& part : parts(component)) {
    if (part.kind == "linear" || part.kind == "csv") continue;
    if (part.kind == "constant") return at(part.path);
    if (part.kind == "table") {
      const int last = static_cast<int>(points(part).size()) - 1;
      if (last >= 0) return at(part.path + QString("[%1][1]").arg(last));
    } else if (const QString value = at(part.path + "." + value_in[part.kind]); !value.isEmpty()) {
      return value;
    }
  }
  return "0";
}

QString FunctionEdit::made(const QString& kind, const QString& value) const {
  QString end = at(QString("stage[%1].end").arg(stage()));
  if (end.isEmpty()) end = "1";
  if (kind == "linear") return "0";
  if (kind == "ramp") return "{ to = " + value + ", end = " + end + " }";
  if (kind == "csv") return "{ file = \"history.csv\" }";
  if (kind == "sine") return "{ amplitude = " + value + ", frequency = 0 }";
  return kind == "table" ? "[[0, " + value + "], [" + end + ", " + value + "]]" : value;
}

void FunctionEdit::choose(int component, const QString& kind) {
  const QString path = component_path(component), value = value_of(component);
  if (key_->type == ValueType::function_vector && at(path_).isEmpty()) set(path_, text_of(key_->fallback));
  if (kind.isEmpty()) {
    set(path, {});
    if (places_.names_below(path_.toStdString()).empty()) set(path_, {});
    return;
  }
  const QString toml = kind == "constant" ? value : "{ " + kind + " = " + made(kind, value) + " }";
  if (key_->type == ValueType::axis_functions && places_.find(path_.toStdString()) == nullptr &&
      places_.names_below(path_.toStdString()).empty())
    return set(path_, "{ " + components_[component] + " = " + toml + " }");
  set(path, toml);
}

void FunctionEdit::add(int component, const QString& kind) {
  const std::vector<FunctionPart> own = parts(component);
  if (own.empty()) return choose(component, kind);
  const QString path = component_path(component), summand = path + "." + kind, toml = made(kind, "0");
  if (own.size() == 1 && own[0].path == path) set(path, "{ constant = " + at(path) + " }");
  const auto same = std::count_if(own.begin(), own.end(), [&](const FunctionPart& p) { return p.kind == kind; });
  if (same == 0 || !may_be_several(kind)) return set(summand, toml);
  const QString before = at(summand);  // one table, or a list of them
  if (!before.startsWith('[')) return set(summand, "[" + before + ", " + toml + "]");
  const auto last = before.lastIndexOf('}') + 1;
  set(summand, before.left(last) + ", " + toml + before.mid(last));
}

void FunctionEdit::remove(int component, const FunctionPart& part) {
  if (parts(component).size() < 2) return;
  if (!part.path.endsWith(']')) return set(part.path, {});
  const QString list = part.path.left(part.path.lastIndexOf('['));
  const int count = places_.count(list.toStdString());
  QStringList others;
  for (int i = 0; i < count; ++i)
    if (const QString own = list + QString("[%1]").arg(i); own != part.path) others << at(own);
  set(list, others.isEmpty() ? QString() : "[" + others.join(", ") + "]");
}

QString FunctionEdit::number(const FunctionNumber& number) const { return shown_value(*number.row, at(number.path)); }

void FunctionEdit::set_number(const FunctionNumber& number, const QString& typed) {
  if (typed.trimmed() == this->number(number)) return;
  set(number.path, typed_value(*number.row, typed));
}

std::vector<FunctionEdit::Row> FunctionEdit::points(const FunctionPart& table) const {
  const Key& number = case_::key_of("<function>.constant");
  std::vector<Row> rows;
  const auto cell = [&](int column) {
    const QString path = table.path + QString("[%1][%2]").arg(rows.size()).arg(column);
    return shown_value(number, at(path));
  };
  while (places_.find((table.path + QString("[%1]").arg(rows.size())).toStdString()) != nullptr)
    rows.push_back({cell(0), cell(1)});
  return rows;
}

void FunctionEdit::set_point(const FunctionPart& table, int row, int column, const QString& typed) {
  std::vector<Row> rows = points(table);
  QString& cell = rows[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
  if (typed.trimmed() == cell) return;
  const QString path = table.path + QString("[%1][%2]").arg(row).arg(column);
  const QString toml = typed_value(case_::key_of("<function>.constant"), typed);
  if (!toml.isEmpty() && places_.find(path.toStdString()) != nullptr) return set(path, toml);
  cell = typed;
  set_points(table, rows);
}

void FunctionEdit::set_points(const FunctionPart& table, const std::vector<Row>& rows) {
  const Key& number = case_::key_of("<function>.constant");
  QStringList items;
  for (const Row& row : rows) {
    QStringList cells;
    for (const QString& cell : row)
      if (const QString toml = typed_value(number, cell); !toml.isEmpty()) cells << toml;
    items << "[" + cells.join(", ") + "]";
  }
  set(table.path, "[" + items.join(", ") + "]");
}

std::vector<FunctionEdit::Row> FunctionEdit::rows_of(const QString& csv) {
  static const QRegularExpression unit(R"([\[(]([^\])]*)[\])])"), number(R"(^[+-]?[0-9.])"), blanks(R"(\s+)");
  std::vector<Row> rows;
  Row units;
  for (const QString& line : csv.split('\n', Qt::SkipEmptyParts)) {
    QStringList cells = line.trimmed().split(blanks);
    for (const char* sign : {",", "\t", ";"})  // what is apart by semicolons may have decimal commas
      if (line.contains(sign)) cells = line.trimmed().split(sign);
    if (cells.size() < 2) continue;
    const Row cell{QString(cells[0]).remove('"').trimmed(), QString(cells[1]).remove('"').trimmed()};
    const bool is_head = !number.match(cell[0]).hasMatch();
    for (std::size_t c = 0; c < cell.size() && is_head; ++c) units[c] = unit.match(cell[c]).captured(1).trimmed();
    if (!is_head) rows.push_back({with_unit(cell[0], units[0]), with_unit(cell[1], units[1])});
  }
  return rows;
}

FunctionEdit::Reading FunctionEdit::read() const {
  Reading reading;
  try {
    const Node root = case_::parse_toml_text(places_.text(), file_);
    const std::string own = path_.toStdString();
    case_::ValueReader reader(reading.problems, std::filesystem::path(file_).parent_path());
    if (const Node* node = node_at(root, path_); node != nullptr) {
      if (key_->type == ValueType::axis_functions) {
        reader.read_axes(*key_, *node, own, reading.given, reading.functions);
      } else if (key_->type == ValueType::function) {
        reader.read(*key_, *node, own, reading.functions[0]);
      } else {
        reader.read(*key_, *node, own, reading.functions);
      }
      if (!may_be_missing()) std::fill_n(reading.given.begin(), components_.size(), true);
    }
    std::vector<Problem> of_stages;
    case_::ValueReader stages(of_stages, {});
    for (int i = 0;; ++i) {
      const QString path = QString("stage[%1].end").arg(i);
      const Node* node = node_at(root, path);
      double end = 0;
      if (node != nullptr) stages.read(case_::key_of("stage[].end"), *node, path.toStdString(), end);
      if (node == nullptr || !of_stages.empty()) break;
      reading.ends.push_back(end);
    }
  } catch (const InputError& error) {
    reading.problems = error.problems();
  }
  return reading;
}

std::vector<Problem> FunctionEdit::problems() const { return read().problems; }

std::vector<double> FunctionEdit::stage_ends() const { return read().ends; }

int FunctionEdit::stage() const { return path_.section('[', 1).section(']', 0, 0).toInt(); }

std::vector<PlotLine> FunctionEdit::curves() const {
  const Reading reading = read();
  std::vector<PlotLine> lines;
  if (!reading.problems.empty() || reading.ends.empty()) return lines;
  for (int c = 0; c < components_.size(); ++c) {
    const auto i = static_cast<std::size_t>(c);
    if (reading.given[i])
      lines.push_back(sampled(components_[c].isEmpty() ? label_of(*key_) : components_[c], reading.functions[i], 0,
                              reading.ends.back()));
  }
  return lines;
}

}  // namespace breccia::gui
