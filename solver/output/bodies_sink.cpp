#include "output/bodies_sink.hpp"

#include "output/atomic_file.hpp"
#include "output/csv_field.hpp"

namespace breccia {

std::string bodies_csv(const std::vector<std::string>& names) {
  std::string text = "body,name\n";
  for (std::size_t body = 0; body < names.size(); ++body)
    text += std::to_string(body) + "," + csv_field(names[body]) + "\n";
  return text;
}

void BodiesSink::start(const RunStart& run) { write_file_atomically(path_, bodies_csv(run.bodies)); }

}  // namespace breccia
