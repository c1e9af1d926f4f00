// Pliant: cloth and soft bodies in real time. Include this one header;
// pictures have one of their own, pliant/render.hpp.
#pragma once

#include "pliant/api.hpp"
#include "pliant/error.hpp"
#include "pliant/mesh.hpp"
#include "pliant/mesh_generators.hpp"
#include "pliant/options.hpp"
#include "pliant/scene.hpp"
#include "pliant/simulation.hpp"
#include "pliant/vec3.hpp"
#include "pliant/version.hpp"
