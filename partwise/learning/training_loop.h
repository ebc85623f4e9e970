// Trains a network: Adam in stages, checkpoints, a log, early stopping, and going on where it stopped.
//
// In `output`: checkpoint.pt (network, optimiser and step: what a training goes on from), best.pt (the network with the
// least validation loss of the stage), log.jsonl (a line a report) and events.out.tfevents.* (the same for
// TensorBoard). Files appear whole or not at all, but for the log and the events, which grow; going on cuts the log
// back to the checkpoint. Random numbers are functions of the seed and the step, so that a training that was stopped
// and went on, at any moment, has the losses of one that was not, to the bit on the same machine with the same number
// of threads.
//
// Several processes (base/ranks.h) share each batch and average gradients through Gloo; MASTER_ADDR and MASTER_PORT say
// where they meet. The first of them writes the files.
//
// Errors: InputError for a folder that cannot be written, holds another training, or holds one where `resume` is not
// set; for a checkpoint that is damaged; for a batch that the processes cannot share evenly; where a loss is no longer
// a number. Cancelled, after a checkpoint.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "partwise/base/progress.h"
#include "partwise/base/ranks.h"
#include "partwise/learning/training_task.h"

namespace partwise {

struct TrainingStage {
  std::int64_t steps = 1000;
  double learning_rate = 1e-3, final_learning_rate = 1e-3;  // in between by a constant factor a step
  double beta1 = 0.9;                                       // of Adam; beta2 is 0.999
};

struct TrainingSettings {
  std::vector<TrainingStage> stages;
  std::int64_t batch = 16;              // rows, of all processes together
  double largest_gradient = 1;          // the norm of all gradients together is brought down to it
  std::int64_t report_every = 50;       // steps; reports are means over these
  std::int64_t checkpoint_every = 500;  // steps
  std::int64_t validate_every = 500;    // steps
  int patience = 0;                     // validations without a better one after which a stage ends; 0: it never does
  std::uint64_t seed = 0;
  std::filesystem::path output;
  std::string configuration;  // what makes this training another than the next; kept in config.json
};

struct TrainingReport {
  std::int64_t step = 0;  // reached
  double loss = 0;        // of the last report
  double best = 0;        // validation loss
};

TrainingReport train(TrainingTask& task, const TrainingSettings& settings, const Rank& rank, bool resume,
                     const Progress& progress = {});

}  // namespace partwise
