#pragma once

#include <string>
#include <string_view>
#include <vector>

/// The arrays of the in-situ channels, by name: the choices of insitu.pipeline.fields and insitu.live.fields. Those of
/// the history depend on the case.
namespace breccia::case_ {

/// Of all channels but the history, as choices of a row of the table of keys.
inline constexpr std::string_view insitu_fields =
    "id|body|material|rank|fragment|stress|von_mises|principal|velocity|displacement|cost|mass|neighbour|"
    "plastic_shear|compaction|plastic_work|face|crack|damage|mode|opening|slip|broken|time_of_failure|state|energy|"
    "normal_force|"
    "tangential_force|force|slip_velocity|point|other_body|other_element|elements|joints|couples|load";

/// Arrays of a channel in its own order, those of all bulk laws included; none of the history and of other words.
[[nodiscard]] std::vector<std::string> fields_of_channel(std::string_view channel);

/// True for what elements remember whose law is drucker_prager, and no others.
[[nodiscard]] bool is_of_plasticity(std::string_view field);

}  // namespace breccia::case_
