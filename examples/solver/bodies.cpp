// SPDX-License-Identifier: MIT
#include "bodies.h"

#include "curvature.h"

namespace solver {

namespace {

double share(double amount, double part, double whole) { return whole == 0 ? 0 : amount * (part / whole); }

}  // namespace

std::vector<Account> measure(const Surface& surface, const std::vector<double>& surfactant) {
  const topoadapt::Components bodies = surface.components();
  std::vector<Account> measured;
  for (const tpa_component& c : bodies) measured.push_back({c.volume, 0});
  const Eigen::VectorXd areas = vertex_areas(points_of(surface), triangles_of(surface));
  for (size_t v = 0; v < surfactant.size(); ++v)
    measured[bodies.labels[v]].surfactant += areas(static_cast<Eigen::Index>(v)) * surfactant[v];
  return measured;
}

void follow(const Surface& surface, Bodies& bodies, std::vector<double>& surfactant) {
  const std::vector<Account> measured = measure(surface, surfactant);
  bodies.follow(surface, measured, [](const Account& owned, const Account& part, const Account& whole) {
    return Account{share(owned.volume, part.volume, whole.volume),
                   share(owned.surfactant, part.surfactant, whole.surfactant)};
  });
  for (size_t v = 0; v < surfactant.size(); ++v) {
    const size_t b = bodies.components().labels[v];
    surfactant[v] = share(surfactant[v], bodies.amounts()[b].surfactant, measured[b].surfactant);
  }
}

void keep_volumes(const Surface& surface, const Bodies& bodies, Points& targets) {
  const Triangles triangles = triangles_of(surface);
  const std::vector<uint32_t>& labels = bodies.components().labels;
  const std::vector<Account>& accounts = bodies.amounts();
  for (int round = 0; round < 3; ++round) {
    const Points normals = vertex_normals(targets, triangles);
    const Eigen::VectorXd areas = vertex_areas(targets, triangles);
    std::vector<double> volume(accounts.size(), 0), area(accounts.size(), 0);
    for (Eigen::Index t = 0; t < triangles.rows(); ++t)
      volume[labels[triangles(t, 0)]] +=
          targets.row(triangles(t, 0)).dot(targets.row(triangles(t, 1)).cross(targets.row(triangles(t, 2)))) / 6;
    for (size_t v = 0; v < labels.size(); ++v) area[labels[v]] += areas(static_cast<Eigen::Index>(v));
    for (size_t v = 0; v < labels.size(); ++v) {
      const size_t b = labels[v];
      targets.row(static_cast<Eigen::Index>(v)) +=
          (accounts[b].volume - volume[b]) / area[b] * normals.row(static_cast<Eigen::Index>(v));
    }
  }
}

}  // namespace solver
