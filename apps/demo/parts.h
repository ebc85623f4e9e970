// What the page shows of decompositions: the shipped models, their ridges, parts and hulls, with figures of both
// measures, and two of them to be taken apart.
#pragma once

#include <string>
#include <vector>

#include "html.h"
#include "models.h"
#include "partwise/parts/solid/decompose.h"
#include "turnable.h"

namespace demo {

struct Figures {  // of one decomposition
  int parts = 0;
  double concavity = 0, volume_ratio = 0, seconds = 0;  // concavity as a share of R; ratio not a number if open
};

struct Decomposed {
  Model model;
  partwise::Mesh mesh;
  partwise::Decomposition parts;  // by the measure hull
  Figures hull, valley;           // by measure
};

Decomposed decompose_model(const Model& model, double tolerance);

struct PartsStory {
  double tolerance = 0;
  struct Row {
    const Decomposed* model;
    std::vector<Picture> pictures;  // from the input to the hulls
  };
  std::vector<Row> models;
  std::vector<Turnable> turned;
};

// Its parts and hulls, to be moved apart.
Turnable turnable_parts(const Decomposed& model);

std::string totals(const PartsStory& story);  // as facts
std::string parts_chapter(const PartsStory& story);
std::string model_credits(const PartsStory& story);

}  // namespace demo
