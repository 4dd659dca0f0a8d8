#pragma once
#include <cmath>
#include <cstddef>

#include "physics/equations/face_geometry.hpp"

namespace cupola {

inline double magnitude(const Vector3& vector) { return std::sqrt(dot(vector, vector)); }

/// sum += factor * vector
inline void add(Vector3& sum, double factor, const Vector3& vector) {
  for (std::size_t axis = 0; axis < 3; ++axis) sum[axis] += factor * vector[axis];
}

}  // namespace cupola
