#pragma once

#include <algorithm>
#include <initializer_list>
#include <stdexcept>
#include <string>
#include <string_view>

#include "advice/advice.hpp"

namespace breccia::test {

/// A line each, beginning with "- ".
inline std::string as_list(const Sentences& sentences) {
  std::string text;
  for (const std::string& sentence : sentences) text += "- " + sentence + "\n";
  return text;
}

/// The sentences of some rules, likewise. Throws where a name is that of no rule.
inline std::string advice_of(std::initializer_list<std::string_view> names, const Subject& subject) {
  std::string text;
  for (const std::string_view name : names) {
    const auto known = [&](const Rule& rule) { return rule.name == name; };
    const auto rule = std::find_if(rules().begin(), rules().end(), known);
    if (rule == rules().end()) throw std::invalid_argument("no rule " + std::string(name));
    text += as_list(rule->find(subject));
  }
  return text;
}

}  // namespace breccia::test
