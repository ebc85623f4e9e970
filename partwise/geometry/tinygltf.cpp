// The one translation unit with tinygltf's implementation.
#define TINYGLTF_IMPLEMENTATION
#include "partwise/geometry/tinygltf_config.h"
