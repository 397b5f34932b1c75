#include "output/folder/bodies_sink.hpp"

#include "run_folder/csv.hpp"
#include "system/atomic_file.hpp"

namespace breccia {

std::string bodies_csv(const std::vector<std::string>& names) {
  std::string text = "body,name\n";
  for (std::size_t body = 0; body < names.size(); ++body)
    text += std::to_string(body) + "," + csv_field(names[body]) + "\n";
  return text;
}

void BodiesSink::start(const RunStart& run) { write_file_atomically(path_, bodies_csv(run.bodies)); }

}  // namespace breccia
