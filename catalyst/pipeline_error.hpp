#pragma once

#include <stdexcept>

namespace breccia::insitu {

/// What a pipeline failed of: one line, without the pipeline's name.
class PipelineError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace breccia::insitu
