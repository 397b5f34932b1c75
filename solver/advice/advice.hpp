#pragma once

#include <span>
#include <string>
#include <vector>

#include "advice/sentences.hpp"
#include "advice/subject.hpp"

/// What `check` advises: a table of rules over a case and its model.
namespace breccia {

/// How much a finding matters, most first.
enum class Level {
  wrong,       ///< the run is not what the case means, or ends with an error: bodies go through each other, loads do
               ///< nothing
  doubtful,    ///< probably an input error: a density of no solid, a ramp that ends after its stage
  inaccurate,  ///< the answer depends on the mesh, on damping or on how suddenly loads act
  costly       ///< the run takes longer, or more disk, than it needs
};

/// "wrong"
[[nodiscard]] const char* name_of(Level level);

struct Rule {
  const char* name;  ///< as `check` prints it, in brackets
  Level level;
  const char* key;  ///< of the case, as in the schema: the one to check first
  bool at_start;    ///< `run` reports it as well, as a warning
  Sentences (*find)(const Subject&);
};

/// All of them, those that matter most first.
[[nodiscard]] std::span<const Rule> rules();

struct Advice {
  const Rule* rule;
  std::string text;  ///< with its remedy and a full stop
};

/// In the order of rules(). @param subject  its model is not a bare one
[[nodiscard]] std::vector<Advice> advise(const Subject& subject);

/// Findings of the rules that `run` reports as well: the run would not be what the case intends, though nothing fails.
/// A bare model will do.
[[nodiscard]] Sentences start_warnings(const case_::Case& input, const Model& model);

}  // namespace breccia
