// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace relucent::venue {

/// Triangles, counter-clockwise seen from outside. `normals`: per vertex, for smooth shading; empty: flat.
/// `map`: texture coordinates per vertex.
struct Mesh {
  std::vector<Eigen::Vector3f> positions;
  std::vector<Eigen::Vector3f> normals;
  std::vector<Eigen::Vector2f> map;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// corner, corner + u, corner + u + v, corner + v; facing u x v; map in metres along u and v.
Mesh rectangle(const Eigen::Vector3f& corner, const Eigen::Vector3f& u, const Eigen::Vector3f& v);

/// A box standing on `base` (the middle of its lower face), turned about the vertical axis.
Mesh box(const Eigen::Vector3f& base, const Eigen::Vector3f& size, float turn);

/// An ellipsoid, each vertex moved along the normal by displacement(position on the unit sphere) metres;
/// map: longitude and latitude in radians.
Mesh ellipsoid(const Eigen::Vector3f& centre, const Eigen::Vector3f& radii, int segments,
               const std::function<float(const Eigen::Vector3f&)>& displacement = {});

/// A profile (radius, height), listed from bottom to top along its outside, rotated about the vertical axis
/// through `base`.
Mesh lathe(const Eigen::Vector3f& base, std::span<const Eigen::Vector2f> profile, int segments);

/// The vertices of a grid, columns x rows, with smooth normals; place(i, j) gives the position of vertex i of
/// `columns`, j of `rows`. `closed`: the last column joins the first.
Mesh grid(int columns, int rows, bool closed, const std::function<Eigen::Vector3f(int, int)>& place,
          const std::function<Eigen::Vector2f(int, int)>& map);

/// Both meshes as one.
Mesh joined(const Mesh& a, const Mesh& b);

}  // namespace relucent::venue
