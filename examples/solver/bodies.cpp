// SPDX-License-Identifier: MIT
#include "bodies.h"

#include <numeric>

#include "curvature.h"

namespace solver {

namespace {

// Sets of bodies, before and after a commit, that share surface.
class Families {
 public:
  explicit Families(size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), size_t{0}); }
  size_t find(size_t i) const {
    while (parent_[i] != i) i = parent_[i];
    return i;
  }
  void join(size_t a, size_t b) { parent_[find(a)] = find(b); }

 private:
  std::vector<size_t> parent_;
};

std::vector<Account> measure(const Surface& surface, const std::vector<double>& surfactant,
                             std::vector<uint32_t>& labels) {
  std::vector<Account> measured;
  for (const tpa_component& c : surface.components(labels)) measured.push_back({c.volume, 0});
  const Eigen::VectorXd areas = vertex_areas(surface.points(), surface.triangles());
  for (size_t v = 0; v < labels.size(); ++v)
    measured[labels[v]].surfactant += areas(static_cast<Eigen::Index>(v)) * surfactant[v];
  return measured;
}

void add(Account& sum, const Account& other) {
  sum.volume += other.volume;
  sum.surfactant += other.surfactant;
}

double share(double amount, double part, double whole) { return whole == 0 ? 0 : amount * (part / whole); }

}  // namespace

Bodies::Bodies(const Surface& surface, const std::vector<double>& surfactant)
    : accounts_(measure(surface, surfactant, labels_)) {}

Account Bodies::total() const {
  Account sum;
  for (const Account& a : accounts_) add(sum, a);
  return sum;
}

void Bodies::follow(const Surface& surface, std::vector<double>& surfactant) {
  std::vector<uint32_t> labels;
  const std::vector<Account> measured = measure(surface, surfactant, labels);
  const size_t old_count = accounts_.size();
  Families families(old_count + measured.size());
  const tpa_vertex_map_view map = surface.map();
  for (uint32_t v = 0; v < map.new_count; ++v)
    for (const uint32_t parent : map.origins[v].parents)
      if (parent != TPA_NONE) families.join(old_count + labels[v], labels_[parent]);

  std::vector<Account> owned(old_count + measured.size()), seen(owned.size()), after;
  std::vector<bool> lives(owned.size(), false);
  for (size_t b = 0; b < old_count; ++b) add(owned[families.find(b)], accounts_[b]);
  for (size_t b = 0; b < measured.size(); ++b) {
    add(seen[families.find(old_count + b)], measured[b]);
    lives[families.find(old_count + b)] = true;
  }
  for (size_t b = 0; b < measured.size(); ++b) {
    const size_t f = families.find(old_count + b);
    after.push_back({share(owned[f].volume, measured[b].volume, seen[f].volume),
                     share(owned[f].surfactant, measured[b].surfactant, seen[f].surfactant)});
  }
  for (size_t f = 0; f < owned.size(); ++f)
    if (!lives[f]) add(lost_, owned[f]);
  for (size_t v = 0; v < labels.size(); ++v)
    surfactant[v] = share(surfactant[v], after[labels[v]].surfactant, measured[labels[v]].surfactant);
  accounts_.swap(after);
  labels_.swap(labels);
}

void Bodies::keep_volumes(const Surface& surface, Points& targets) const {
  const Triangles triangles = surface.triangles();
  for (int round = 0; round < 3; ++round) {
    const Points normals = vertex_normals(targets, triangles);
    const Eigen::VectorXd areas = vertex_areas(targets, triangles);
    std::vector<double> volume(accounts_.size(), 0), area(accounts_.size(), 0);
    for (Eigen::Index t = 0; t < triangles.rows(); ++t)
      volume[labels_[triangles(t, 0)]] +=
          targets.row(triangles(t, 0)).dot(targets.row(triangles(t, 1)).cross(targets.row(triangles(t, 2)))) / 6;
    for (size_t v = 0; v < labels_.size(); ++v) area[labels_[v]] += areas(static_cast<Eigen::Index>(v));
    for (size_t v = 0; v < labels_.size(); ++v) {
      const size_t b = labels_[v];
      targets.row(static_cast<Eigen::Index>(v)) +=
          (accounts_[b].volume - volume[b]) / area[b] * normals.row(static_cast<Eigen::Index>(v));
    }
  }
}

}  // namespace solver
