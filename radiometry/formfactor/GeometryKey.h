// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "radiometry/scene/ContentKey.h"
#include "radiometry/scene/Scene.h"

namespace radiometry
{

/// What operators depend on whatever they follow: points, triangles, the cells that these belong
/// to, the sides that receive, and which triangles let how much light through.
ContentKey KeyOfGeometry(const Scene& scene);

/// What operators that follow light over mirrors and panes depend on beside: specular reflectance
/// and shininess.
ContentKey KeyOfMirrors(const Scene& scene);

} // namespace radiometry
