#include <avi/solver.hpp>

#include <mpi.h>

#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <vector>

// Many starts on many machines: every rank takes each so manieth start, on one thread, with the same choice
// of monitor, order and step; the first one shows progress and writes one file. The file has the same bits on
// any number of ranks.
//
//   mpirun -n 2 mpi_many_starts states.tsv

namespace {

constexpr int all = 60;

avi::State<2> start(int i) { return {.q = {0.0, 0.1 + 0.003 * i}, .p = {0.2, 0.0}}; }

void run(const char* file) {
  int rank = 0, ranks = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);

  const auto henon_heiles = [](const auto& q, const auto& p) {
    return 0.5 * (p[0] * p[0] + p[1] * p[1] + q[0] * q[0] + q[1] * q[1]) + q[0] * q[0] * q[1] -
           q[1] * q[1] * q[1] / 3.0;
  };
  // The same input gives the same choice: every rank makes its own.
  const avi::Solver solver(henon_heiles, start(all / 2), 100.0, 1e-9, {.check = false});

  std::vector<double> ends(4 * all, 0.0);
  for (int i = rank; i < all; i += ranks) {
    const avi::State<2> z = solver.run(start(i), 100.0).state;
    for (int k = 0; k < 2; ++k)
      ends[4 * static_cast<std::size_t>(i) + k] = z.q[k],
                                             ends[4 * static_cast<std::size_t>(i) + 2 + k] = z.p[k];
    if (rank == 0 && i / ranks % 10 == 0) std::fprintf(stderr, "start %d of %d\n", i + 1, all);
  }
  // Every entry comes from one rank, and zeros from the others.
  MPI_Allreduce(MPI_IN_PLACE, ends.data(), 4 * all, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);

  if (rank != 0) return;
  std::FILE* out = std::fopen(file, "w");
  for (std::size_t i = 0; out && i < all; ++i)
    std::fprintf(out, "%a\t%a\t%a\t%a\n", ends[4 * i], ends[4 * i + 1], ends[4 * i + 2], ends[4 * i + 3]);
  bool written = out && std::ferror(out) == 0;
  if (out && std::fclose(out) != 0) written = false;  // where a full disk may show first
  if (!written) {
    std::fprintf(stderr, "%s cannot be written\n", file);
    MPI_Abort(MPI_COMM_WORLD, 1);
  }
}

}  // namespace

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  if (argc == 2)
    run(argv[1]);
  else
    std::fprintf(stderr, "mpi_many_starts <file>\n");
  MPI_Finalize();
  return argc == 2 ? EXIT_SUCCESS : EXIT_FAILURE;
}
