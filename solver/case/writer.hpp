#pragma once

#include <optional>
#include <string>
#include <vector>

#include "case/case.hpp"
#include "case/schema.hpp"

namespace breccia::case_ {

/// The case as TOML in SI units with every default written out, units as comments. read_case() makes an equal Case of
/// it: numbers are written with as many digits as they need to come back bit for bit, files with their absolute names.
/// Case::resolved is ignored.
[[nodiscard]] std::string write_case(const Case& c);

/// A key of an entry as write_case() writes it.
struct WrittenKey {
  const Key* key = nullptr;
  std::string value;             ///< TOML
  std::optional<double> number;  ///< in the key's unit, where the value is one number
};

/// The keys of an entry of a list; those of sections inside it, as [joint.softening], stand last.
[[nodiscard]] std::vector<WrittenKey> written_keys(const Material& material);
[[nodiscard]] std::vector<WrittenKey> written_keys(const Joint& joint);
[[nodiscard]] std::vector<WrittenKey> written_keys(const Contact& contact);

/// A text as a TOML string in quotes; control characters escaped.
[[nodiscard]] std::string toml_text(const std::string& text);

}  // namespace breccia::case_
