// The rendering layer (dissertation, section 3.3.1): images of normals, a material and a light, differentiable in all
// three, for networks and optimisers.
//
// exact_images takes the sum (3.2) for every pixel (differentiable_sum.h). mapped_images takes it once for a map of
// map_size x map_size normals an image and looks pixels up (disk_lookup.h): its cost grows with the map and the light
// and hardly with the picture, and it differs from the exact form where highlights are narrower than its texels.
// bench/layer_bench.py prints both. The halves of the latter are reflectance_maps and looked_up_images, for maps that
// are there already or that serve several images. Gradients are analytic and first order: they have none of their own.
// Of those to normals the part along the normal means nothing, and the two forms differ in it: a network's last layer,
// which makes unit vectors, drops it.
//
// Shapes: normals B x 3 x H x W, unit vectors in camera space (x right, y up, z towards the viewer), zero where there
// is background; material B x 108, the coefficients of a Dsbrdf; light B x 3 x h x w, an equirectangular map of linear
// radiance (environment_light.h); maps B x 3 x T, the colours of a DiskLookup's T normals in their order. Result:
// B x 3 x H x W, linear RGB, zero in the background. Float or double, on the CPU, one type for all. Images in parallel,
// and blocks within them: the same bits for any number of threads. Errors: CheckFailed for other shapes or types.
#pragma once

#include <ATen/core/Tensor.h>

namespace partwise {

at::Tensor exact_images(const at::Tensor& normals, const at::Tensor& material, const at::Tensor& light);
at::Tensor mapped_images(const at::Tensor& normals, const at::Tensor& material, const at::Tensor& light,
                         int map_size = 64);

at::Tensor reflectance_maps(const at::Tensor& material, const at::Tensor& light, int map_size = 64);

// Where light changes and material does not: the maps are linear in light, and each row of `transport`, B x 3 x hw x T,
// is what one of its pixels adds to them. It takes as long as one pass of reflectance_maps and 4 bytes an element (44
// MB for 64 x 32 light and maps of 48); gradients go to light (B or 1 x 3 x h x w) alone.
at::Tensor map_transport(const at::Tensor& material, int rows, int columns, int map_size);
at::Tensor transported_maps(const at::Tensor& transport, const at::Tensor& light);

at::Tensor looked_up_images(const at::Tensor& normals, const at::Tensor& maps, int map_size);

}  // namespace partwise
