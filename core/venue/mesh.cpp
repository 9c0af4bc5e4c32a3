// SPDX-License-Identifier: MIT
#include "relucent/venue/mesh.h"

#include <Eigen/Geometry>
#include <cmath>

#include "relucent/venue/pi.h"

namespace relucent::venue {
namespace {

using Eigen::Vector2f;
using Eigen::Vector3f;

/// Vertex normals as the mean of their triangles', weighted by area.
void smoothNormals(Mesh& mesh) {
  mesh.normals.assign(mesh.positions.size(), Vector3f::Zero());
  for (const auto& triangle : mesh.triangles) {
    const Vector3f& a = mesh.positions[triangle[0]];
    Vector3f normal = (mesh.positions[triangle[1]] - a).cross(mesh.positions[triangle[2]] - a);
    for (std::uint32_t vertex : triangle) mesh.normals[vertex] += normal;
  }
  for (Vector3f& normal : mesh.normals) normal.normalize();
}

}  // namespace

Mesh rectangle(const Vector3f& corner, const Vector3f& u, const Vector3f& v) {
  Mesh mesh;
  mesh.positions = {corner, corner + u, corner + u + v, corner + v};
  mesh.map = {{0.0f, 0.0f}, {u.norm(), 0.0f}, {u.norm(), v.norm()}, {0.0f, v.norm()}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

Mesh joined(const Mesh& a, const Mesh& b) {
  Mesh mesh = a;
  std::uint32_t first = static_cast<std::uint32_t>(a.positions.size());
  mesh.positions.insert(mesh.positions.end(), b.positions.begin(), b.positions.end());
  mesh.normals.insert(mesh.normals.end(), b.normals.begin(), b.normals.end());
  mesh.map.insert(mesh.map.end(), b.map.begin(), b.map.end());
  for (const auto& t : b.triangles) mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  return mesh;
}

Mesh box(const Vector3f& base, const Vector3f& size, float turn) {
  Eigen::AngleAxisf rotation(turn, Vector3f::UnitY());
  Vector3f x = rotation * Vector3f(size.x(), 0.0f, 0.0f), y(0.0f, size.y(), 0.0f);
  Vector3f z = rotation * Vector3f(0.0f, 0.0f, size.z());
  Vector3f low = base - 0.5f * x - 0.5f * z, high = low + x + y + z;
  Mesh mesh = joined(rectangle(low + z, x, y), rectangle(low + x, -x, y));
  mesh = joined(joined(mesh, rectangle(low, z, y)), rectangle(high - y, -z, y));
  return joined(joined(mesh, rectangle(low + y + z, x, -z)), rectangle(low, x, z));
}

Mesh grid(int columns, int rows, bool closed, const std::function<Vector3f(int, int)>& place,
          const std::function<Vector2f(int, int)>& map) {
  Mesh mesh;
  for (int j = 0; j < rows; ++j) {
    for (int i = 0; i < columns; ++i) {
      mesh.positions.push_back(place(i, j));
      mesh.map.push_back(map(i, j));
    }
  }
  auto vertex = [&](int i, int j) { return static_cast<std::uint32_t>(j * columns + i % columns); };
  auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    Vector3f area = (mesh.positions[b] - mesh.positions[a]).cross(mesh.positions[c] - mesh.positions[a]);
    // At a pole a square of the grid is one triangle, the other has no area.
    if (area.squaredNorm() > 1e-18f) mesh.triangles.push_back({a, b, c});
  };
  for (int j = 0; j + 1 < rows; ++j) {
    for (int i = 0; i + 1 < columns + (closed ? 1 : 0); ++i) {
      add(vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1));
      add(vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1));
    }
  }
  smoothNormals(mesh);
  return mesh;
}

Mesh ellipsoid(const Vector3f& centre, const Vector3f& radii, int segments,
               const std::function<float(const Vector3f&)>& displacement) {
  int rows = segments / 2 + 1;
  auto angles = [&](int i, int j) {
    return Vector2f(2.0f * pi * static_cast<float>(i) / static_cast<float>(segments),
                    pi * (static_cast<float>(j) / static_cast<float>(rows - 1) - 0.5f));
  };
  auto place = [&](int i, int j) -> Vector3f {
    Vector2f angle = angles(i, j);
    // Exactly zero at the poles, so that all their vertices coincide.
    float ring = j == 0 || j == rows - 1 ? 0.0f : std::cos(angle.y());
    Vector3f onSphere(ring * std::sin(angle.x()), std::sin(angle.y()), ring * std::cos(angle.x()));
    Vector3f normal = onSphere.cwiseQuotient(radii).normalized();
    float lift = displacement ? displacement(onSphere) : 0.0f;
    return centre + onSphere.cwiseProduct(radii) + lift * normal;
  };
  Mesh mesh = grid(segments, rows, true, place, angles);
  // A pole's vertices lie in one place and must agree on the normal.
  for (int i = 0; i < segments; ++i) {
    mesh.normals[static_cast<std::size_t>(i)] = Vector3f(0.0f, -1.0f, 0.0f);
    mesh.normals[static_cast<std::size_t>((rows - 1) * segments + i)] = Vector3f::UnitY();
  }
  return mesh;
}

Mesh lathe(const Vector3f& base, std::span<const Vector2f> profile, int segments) {
  auto place = [&](int i, int j) -> Vector3f {
    float angle = 2.0f * pi * static_cast<float>(i) / static_cast<float>(segments);
    const Vector2f& point = profile[static_cast<std::size_t>(j)];
    return base + Vector3f(point.x() * std::sin(angle), point.y(), point.x() * std::cos(angle));
  };
  auto map = [&](int i, int j) {
    return Vector2f(2.0f * pi * static_cast<float>(i) / static_cast<float>(segments),
                    profile[static_cast<std::size_t>(j)].y());
  };
  Mesh mesh = grid(segments, static_cast<int>(profile.size()), true, place, map);
  for (std::size_t vertex = 0; vertex < mesh.positions.size(); ++vertex) {
    if (profile[vertex / static_cast<std::size_t>(segments)].x() > 0.0f) continue;
    mesh.normals[vertex] = Vector3f(0.0f, mesh.normals[vertex].y() < 0.0f ? -1.0f : 1.0f, 0.0f);
  }
  return mesh;
}

}  // namespace relucent::venue
