#pragma once

namespace breccia {

/// Largest error of a step in which a linear force begins or ends, as a share of k D^2 with its stiffness k and the
/// motion D: central differences do the work 1/2 k d D where d < D stores 1/2 k d^2; they differ most for d = D/2.
inline constexpr double kLargestWorkError = 0.125;
/// Share of that below which nothing is put right.
inline constexpr double kNegligibleWorkError = 1e-4;

}  // namespace breccia
