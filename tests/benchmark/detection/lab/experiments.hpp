#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace breccia::lab {

struct Options {
  std::vector<std::string> experiments{"I", "II", "III", "IV", "V", "VI", "VII", "bytes", "points"};
  std::size_t largest = 10'000'000;     ///< bodies
  int repeat = 3;                       ///< runs of each experiment; the shortest time counts
  double budget = 60;                   ///< s, of one algorithm in one run; longer runs are not begun
  std::vector<std::string> algorithms;  ///< all where empty
  std::string scene;                    ///< points: only scenes whose name holds this
  bool peers = true;
  std::filesystem::path folder = "runs/detection";
};

/// Experiments I to VI: equal_size.csv. Throws std::runtime_error where two searches see different pairs.
void run_equal_size(const Options& options);
/// Bytes a body of each search of equal size, 16-bit and 32-bit coordinates: bytes.csv.
void run_bytes(const Options& options);
/// Experiment VII, [Schiava, 7.2, tables 7.1 and 7.2]: two linked lists in one array walked in turn, one behind the
/// other (A) or interleaved (B): memory_order.csv.
void run_memory_order(const Options& options);
/// Points against tetrahedra: points.csv. Throws like run_equal_size().
void run_points(const Options& options);

/// One detection of one algorithm on the first of options.experiments with options.largest bodies or tetrahedra
/// (points: in the first scene), inside the function breccia_counted_cycle, for callgrind's --toggle-collect. A
/// detection before it and a move of the bodies are left out, so that storage is there and old orders are used. Prints
/// what it has seen. Throws std::invalid_argument if there is no such algorithm, experiment or scene.
void count_cycle(const Options& options, const std::string& algorithm);
/// "equal_size NAME" or "points NAME", a line for each algorithm at hand.
void print_names(const Options& options);

/// True for an algorithm the user wants.
bool wanted(const Options& options, const std::string& algorithm);
/// Processor time of this process, all threads, s: what others do on the machine counts little.
double now();

}  // namespace breccia::lab
