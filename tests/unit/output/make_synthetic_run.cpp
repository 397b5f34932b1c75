// Writes a run folder full of synthetic frames, for the tests of what reads one: make_synthetic_run FOLDER [CUBES] [FRAMES].

#include <chrono>
#include <exception>
#include <iostream>
#include <string>

#include "output/run_folder.hpp"
#include "output/summary.hpp"
#include "output/vtkhdf_sink.hpp"
#include "synthetic_plate.hpp"

int main(int argc, char** argv) try {
  using namespace breccia;
  if (argc < 2) {
    std::cerr << "usage: make_synthetic_run FOLDER [CUBES] [FRAMES]\n";
    return 1;
  }
  test::SyntheticPlate plate;
  if (argc > 2) plate.cubes = std::stoi(argv[2]);
  const int frames = argc > 3 ? std::stoi(argv[3]) : 6;
  const RunFolder folder = prepare_run_folder(argv[1], "title = \"synthetic plate\"\n",
                                              collect_provenance("test", {argv, argv + argc}), OldResults::overwrite);
  VtkhdfSink sink(folder.frames());
  double slowest = 0;
  std::size_t elements = 0;
  for (int i = 0; i < frames; ++i) {
    const Frame frame = plate.frame(i, plate.end * i / std::max(frames - 1, 1));
    elements = frame.elements.id.size();
    const auto before = std::chrono::steady_clock::now();
    sink.frame(frame);
    slowest = std::max(slowest, std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count());
  }
  std::cout << elements << " elements, " << frames << " frames, slowest " << slowest << " s\n";
  return 0;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
