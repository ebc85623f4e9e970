// A peer of the networks that go through normals, material and light: one that has no idea of how pictures come about
// (the dissertation's baseline 1, section 3.4.5, after Kulkarni et al. 2015).
//
// An encoder turns the picture into features of its material and features of everything else. From the first a linear
// layer tells the material's coefficients, which keeps the two apart; they are then exchanged for features of the
// wanted material, and a decoder, which sees the encoder's maps as well, draws the object in it.
//
// Shapes: pictures B x 4 x S x S as NormalNetwork has them; materials B x 108, scaled. Errors: CheckFailed for other
// shapes, and for sizes that are no power of two from 128 on.
#pragma once

#include <ATen/core/Tensor.h>

#include <filesystem>
#include <memory>
#include <utility>

#include "partwise/editing/material_range.h"
#include "partwise/editing/sampled_task.h"
#include "partwise/learning/checkpoint.h"
#include "partwise/learning/perceptual_features.h"

namespace partwise {

struct Redrawn {
  at::Tensor material;  // B x 108, of the picture, scaled
  at::Tensor image;     // B x 3 x S x S, in the wanted material; display values
};

class EncoderDecoder {
 public:
  EncoderDecoder(int size, const MaterialRange& range);

  Redrawn operator()(const at::Tensor& pictures, const at::Tensor& wanted) const;

  MaterialRange range() const;
  torch::nn::Module& module() const;
  WeightsFile weights() const;

 private:
  struct Modules;
  std::shared_ptr<Modules> modules_;
};

// Errors: those of reading; InputError for another kind of network.
EncoderDecoder read_encoder_decoder(const std::filesystem::path& path);

// Trained on the same pictures as the others, by the terms `material`, `pixel` and `perceptual` of the target alone.
class EncoderDecoderTask final : public SampledTask {
 public:
  // The samples must outlive this.
  EncoderDecoderTask(EncoderDecoder network, const EditSamples& training, const EditSamples& validation,
                     const EditingTaskSettings& settings)
      : SampledTask(training, validation, settings), network_(std::move(network)) {}

  torch::nn::Module& network() override { return network_.module(); }
  WeightsFile weights() const override { return network_.weights(); }

 private:
  Losses losses(const EditBatch& batch, const EditingWeights& weights) const override;

  EncoderDecoder network_;
  PerceptualFeatures features_ = PerceptualFeatures::shipped();
};

}  // namespace partwise
