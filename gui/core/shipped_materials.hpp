#pragma once

#include <QByteArray>

namespace breccia::gui {

/// TOML of the materials that come with the program (core/material_library.hpp reads it). Every value has its source.
/// Energies of fracture that follow from a published toughness are K_Ic^2 (1 - nu^2) / E.
[[nodiscard]] QByteArray shipped_materials_text();

}  // namespace breccia::gui
