// Writes a run folder full of synthetic frames, for the tests of what reads one: make_synthetic_run FOLDER [CUBES]
// [FRAMES]. Started by mpiexec, every rank writes its piece.

#include <chrono>
#include <exception>
#include <iostream>
#include <string>

#include "output/folder/run_folder.hpp"
#include "output/folder/summary.hpp"
#include "output/frames/vtkhdf_sink.hpp"
#include "parallel/mpi_session.hpp"
#include "synthetic_plate.hpp"

int main(int argc, char** argv) try {
  using namespace breccia;
  if (argc < 2) {
    std::cerr << "usage: make_synthetic_run FOLDER [CUBES] [FRAMES]\n";
    return 1;
  }
  const MpiSession session(argc, argv);
  const Communicator& world = session.world();
  test::SyntheticPlate plate;
  if (argc > 2) plate.cubes = std::stoi(argv[2]);
  const int frames = argc > 3 ? std::stoi(argv[3]) : 6;
  const RunFolder folder{argv[1]};
  world.agree([&] {
    if (!world.is_root()) return;
    (void)prepare_run_folder(folder.root, "title = \"synthetic plate\"\n",
                             collect_provenance("test", {argv, argv + argc}), OldResults::overwrite);
  });
  VtkhdfSink sink(folder.frames(), {}, world);
  double slowest = 0;
  std::size_t elements = 0;
  for (int i = 0; i < frames; ++i) {
    const Frame whole = plate.frame(i, plate.end * i / std::max(frames - 1, 1));
    const Frame mine = test::piece_of(whole, world.rank(), world.size());
    elements = whole.elements.id.size();
    world.barrier();
    const auto before = std::chrono::steady_clock::now();
    sink.frame(mine);
    slowest = std::max(slowest, std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count());
  }
  if (world.is_root()) std::cout << elements << " elements, " << frames << " frames, slowest " << slowest << " s\n";
  return 0;
} catch (const std::exception& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
