#pragma once

#include "case/case.hpp"
#include "model/model.hpp"
#include "simulation/contact_search.hpp"

namespace breccia {

/// The case's section [detection], and what the search has to know of the model.
[[nodiscard]] ContactSearchParams search_params(const case_::Case& input, const Model& model);

}  // namespace breccia
