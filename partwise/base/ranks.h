// Which of several machines or processes this one is, as whatever started them says in the environment: RANK and
// WORLD_SIZE (torchrun), mpirun's (OMPI_COMM_WORLD_RANK and _SIZE, PMI_RANK and _SIZE), srun's (SLURM_PROCID and
// SLURM_NTASKS), Kubernetes' indexed jobs (JOB_COMPLETION_INDEX, with WORLD_SIZE). The first pair that is there counts;
// of none, one process alone.
//
// Errors: InputError for half a pair, for what is no whole number, and for a rank that is not below the size.
#pragma once

#include <functional>
#include <optional>
#include <string>

namespace partwise {

struct Rank {
  int rank = 0;  // 0 .. size - 1
  int size = 1;
};

// `variable` gives the value of an environment variable, or nothing.
Rank rank_of(const std::function<std::optional<std::string>(const char*)>& variable);
Rank rank_from_environment();

}  // namespace partwise
