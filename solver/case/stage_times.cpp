#include "case/stage_times.hpp"

namespace breccia::case_ {

Stage brought_forward(Stage stage, double functions, double end) {
  if (end != 0) stage.end -= end;
  if (functions == 0) return stage;
  const auto bring = [&](TimeFunction& f) { f = f.earlier(functions); };
  for (TimeFunction& f : stage.gravity) bring(f);
  for (Constraint& constraint : stage.constraints)
    for (TimeFunction& f : constraint.value) bring(f);
  for (Pressure& pressure : stage.pressures) bring(pressure.value);
  for (Traction& traction : stage.tractions)
    for (TimeFunction& f : traction.value) bring(f);
  for (Force& force : stage.forces)
    for (TimeFunction& f : force.value) bring(f);
  return stage;
}

}  // namespace breccia::case_
