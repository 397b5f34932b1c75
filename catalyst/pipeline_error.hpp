#pragma once

#include <stdexcept>

namespace breccia::insitu {

/// What a pipeline failed of: one line, without the pipeline's name.
class PipelineError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Other ranks have not come where this one waits for them: nothing collective can follow.
class Abandoned : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace breccia::insitu
