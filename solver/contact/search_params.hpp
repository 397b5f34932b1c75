#pragma once

#include "case/case.hpp"
#include "contact/contact_search.hpp"
#include "model/model.hpp"

namespace breccia {

/// The case's section [detection], and what the search has to know of the model.
[[nodiscard]] ContactSearchParams search_params(const case_::Case& input, const Model& model);

}  // namespace breccia
