// A data set of images in shards (docs/dataset.md): OUT/shard-000000.tar and so on, each of `images_per_shard` images
// with what is known of their pixels (dataset_images.h), in the form that WebDataset reads.
//
// Rank r of n makes the shards whose number is r modulo n. Shards that are there are skipped, a shard appears whole or
// not at all, and its bytes depend on the configuration alone: work that was stopped, at any moment, is gone on with by
// running it again. OUT/dataset.json keeps what the shards were made from; another configuration is refused.
//
// Images are rendered on all threads and written in order; a few are in memory at a time, whatever their number. The
// same bytes for any number of threads and ranks. Errors: InputError; Cancelled, the finished shards stay.
#pragma once

#include "partwise/appearance/synthesis/dataset_config.h"
#include "partwise/base/progress.h"
#include "partwise/base/ranks.h"

namespace partwise {

struct DatasetReport {
  int images = 0, shards = 0;  // made
  int skipped = 0;             // shards of this rank that were there
  double seconds = 0;          // of rendering and writing, wall time
};

DatasetReport make_dataset(const DatasetConfig& config, const Rank& rank, const Progress& progress = {});

}  // namespace partwise
