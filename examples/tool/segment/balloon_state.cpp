// SPDX-License-Identifier: MIT
#include "tool/segment/balloon_state.h"

#include <cstring>

#include "tool/io/files.h"

namespace tool {

namespace {

constexpr std::string_view mark = "topoadapt balloon 5\n";

// The same members in the same order for writing and reading: visit(member) for each number.
template <class Balloon, class Visit>
void for_each_number(Balloon& b, Visit visit) {
  visit(b.result.iterations);
  visit(b.forces.edge_length);
  for (auto& q : b.quiet) visit(q);
  visit(b.swing.iterations);
  for (auto* volume : {&b.swing.least, &b.swing.most, &b.swing.least_before, &b.swing.most_before}) visit(*volume);
  visit(b.swing.at_rest);
  visit(b.patience);
  visit(b.remeshing);
  visit(b.hurry);
  visit(b.ripe);
  visit(b.stretch);
}

template <class Particle, class Visit>
void for_each_number_of(Particle& p, Visit visit) {
  visit(p.gain);
  visit(p.last);
  visit(p.resting);
  visit(p.due);
}

struct Reader {
  std::string_view rest;
  bool good = true;

  template <class T>
  void operator()(T& value) {
    good = good && rest.size() >= sizeof(T);
    if (!good) return;
    value = load<T>(rest.data(), false);
    rest.remove_prefix(sizeof(T));
  }
};

// FNV-1a of 64 bits.
struct Hash {
  uint64_t value = 0xcbf29ce484222325;

  template <class T>
  void operator()(T word) {
    uint64_t bits = 0;
    std::memcpy(&bits, &word, sizeof word);
    value = (value ^ bits) * 0x100000001b3;
  }
};

uint64_t hash_of(std::string_view bytes) {
  Hash hash;
  for (const char c : bytes) hash(c);
  return hash.value;
}

// What decides how a balloon goes on: the volume, and the options that the start has not used up.
uint64_t hash_of_work(const Balloon& b) {
  Hash hash;
  const Volume& volume = b.forces.volume;
  for (const int size : {volume.nx, volume.ny, volume.nz}) hash(size);
  for (const Point& axis : volume.to_world.axes)
    for (const double part : axis) hash(part);
  for (const double place : volume.to_world.origin) hash(place);
  for (const float grey : volume.values) hash(grey);
  const BalloonOptions& o = b.o;
  for (const Point& seed : o.seeds)
    for (const double place : seed) hash(place);
  for (const double number :
       {o.threshold.value, o.edge_length, o.edge_thin, o.edge_fine, o.coarseness, o.speed, o.width, o.tension})
    hash(number);
  hash(o.threshold.bright);
  hash(o.patience);
  return hash.value;
}

constexpr const char* damaged = "the saved state is damaged, or of another version";

}  // namespace

tpa_config balloon_config() {
  tpa_config config;
  tpa_config_init(&config, sizeof config);
  config.max_vertices = 16384;
  return config;
}

void adopt(Balloon& b) {
  b.mesh = b.surface.copy();
  b.x = b.mesh.positions;
}

Status save(const Balloon& b, BalloonState& state) {
  tpa_issue issue;
  size_t size = 0;
  tpa_save(b.surface.context(), nullptr, 0, &size, &issue);
  std::string library(size, '\0');
  if (tpa_save(b.surface.context(), library.data(), size, &size, &issue) != TPA_OK) return failure(describe(issue));
  std::string& bytes = state.bytes;
  bytes = mark;
  append_little_endian(bytes, hash_of_work(b));
  const auto append = [&](const auto& value) { append_little_endian(bytes, value); };
  for_each_number(b, append);
  append(static_cast<uint64_t>(b.particles.size()));
  for (const Particle& p : b.particles) for_each_number_of(p, append);
  for (const double place : b.x) append(place);
  bytes += library;
  append_little_endian(bytes, hash_of(bytes));
  return success();
}

Status restore(Balloon& b, const BalloonState& state) {
  std::string_view bytes = state.bytes;
  uint64_t sum = 0, work = 0;
  if (bytes.size() < mark.size() + sizeof sum || bytes.substr(0, mark.size()) != mark) return failure(damaged);
  const size_t end = bytes.size() - sizeof sum;
  Reader{bytes.substr(end)}(sum);
  if (sum != hash_of(bytes.substr(0, end))) return failure(damaged);
  Reader read{bytes.substr(mark.size(), end - mark.size())};
  read(work);
  if (work != hash_of_work(b)) return failure("the saved state is of another volume or of other options");
  for_each_number(b, [&](auto& value) { read(value); });
  uint64_t count = 0;
  read(count);
  constexpr size_t bytes_of_vertex = 13 + 24;
  if (!read.good || count > read.rest.size() / bytes_of_vertex) return failure(damaged);
  b.particles.resize(static_cast<size_t>(count));
  for (Particle& p : b.particles) for_each_number_of(p, [&](auto& value) { read(value); });
  std::vector<double> x(3 * count);
  for (double& place : x) read(place);
  if (Status s = b.surface.resume(balloon_config(), read.rest); !s) return failure(damaged, " (", s.message, ")");
  adopt(b);
  if (b.x.size() != x.size() || !(b.forces.edge_length > 0) || !(b.stretch >= 1)) return failure(damaged);
  b.x.swap(x);
  return success();
}

}  // namespace tool
