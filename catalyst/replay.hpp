#pragma once

#include <filesystem>
#include <string>

#include "catalyst/adaptor.hpp"

namespace breccia::insitu {

/// Feeds recorded channels, folder/<channel>/<channel>.pvd and folder/history/history.csv, through the pipelines of the
/// adaptor, instant after instant in the order of steps; a pipeline is executed at the instants that have all its
/// channels. The recorded pieces are dealt out to the ranks in contiguous shares. One that fails is not executed again,
/// and the others continue. Collective. Throws PipelineError, on all ranks: nothing recorded, a channel that a pipeline
/// needs was never recorded, files that cannot be read; in the end, with the failures of the pipelines.
/// @return  notices of the pipelines, see Adaptor::notices
[[nodiscard]] std::string replay(Adaptor& adaptor, const std::filesystem::path& folder);

}  // namespace breccia::insitu
