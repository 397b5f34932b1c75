#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "case/case.hpp"
#include "model/model.hpp"

namespace breccia {

/// Surfaces whose joints the stages of a case break, ascending.
[[nodiscard]] std::vector<std::string> surfaces_to_break(const case_::Case& input);

/// Faces of a surface that have joints.
struct SurfaceJoints {
  std::int64_t breakable = 0, unbreakable = 0;
};

/// Those of the model, which may be bare, or of a piece's originals, of each surface. O(faces of the surfaces).
[[nodiscard]] std::vector<SurfaceJoints> joints_on(const Model& model, std::span<const std::string> surfaces);

/// Throws InputError with every stage.broken that names a surface without joints, or with unbreakable ones.
/// @param joints  of surfaces_to_break(input), of the whole model
void refuse_what_cannot_break(const case_::Case& input, std::span<const SurfaceJoints> joints);

}  // namespace breccia
