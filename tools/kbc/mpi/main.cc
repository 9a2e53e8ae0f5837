// kbc-fleet-mpi: what `kbc fleet` becomes in an MPI job. The same commands as kbc; `fleet` shares its work with the other ranks.
#include <cstdio>

#include "tools/kbc/commands.h"
#include "tools/kbc/mpi/mpi_ranks.h"
#include "tools/kbc/run_kbc.h"

int main(int argc, char** argv) {
  int provided = MPI_THREAD_SINGLE;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_SERIALIZED, &provided);
  if (provided < MPI_THREAD_SERIALIZED) {
    std::fputs("kbc: error: this MPI was built without threads; `kbc fleet --shard i/n` does without MPI\n", stderr);
    MPI_Abort(MPI_COMM_WORLD, kb::cli::kErrors);
  }
  kb::cli::MpiRanks ranks;
  const int code = kb::cli::run_kbc_guarded(argc, argv, &ranks);
  // An error on rank 0 is heard by all ranks, which end. After an error on another rank or a bug, or without memory, the others would wait for ever.
  if (ranks.rank() != 0 && code == kb::cli::kErrors) MPI_Abort(MPI_COMM_WORLD, code);
  if (code == kb::cli::kBug || code == kb::cli::kOutOfMemory) MPI_Abort(MPI_COMM_WORLD, code);
  ranks.settle();
  MPI_Finalize();
  return code;
}
