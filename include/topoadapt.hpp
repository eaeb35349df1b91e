// SPDX-License-Identifier: MIT
// topoadapt.hpp: the library for C++17, on topoadapt.h alone. A Mesh owns its block, takes and gives spans, throws
// Error, and grows by itself where a limit is reached. docs/cpp.md has the reasons; topoadapt.h has the
// contract of each call.
//
//     topoadapt::Mesh mesh(positions, triangles);     any contiguous containers of numbers or of triples
//     mesh.move(targets);                             each step: the wanted positions of vertices
//     mesh.step();                                    each step: adapts the topology, commits
//     mesh.carry(temperature);                        each step: values of vertices follow the commit
//
// Spans stay valid until the next call of a function that is not const. Every commit replaces maps and events, so all
// values are carried after each of step, advance, adapt, remesh, smooth and reorder, before the next.
#ifndef TOPOADAPT_HPP
#define TOPOADAPT_HPP

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "topoadapt.h"

namespace topoadapt {

// ---------------------------------------------------------------- errors, structures, spans

// A failed call. The mesh is bit for bit as before.
class Error : public std::runtime_error {
 public:
  explicit Error(const tpa_issue& issue) : std::runtime_error(text_of(issue)), issue_(issue) {}
  const tpa_issue& issue() const noexcept { return issue_; }
  tpa_status status() const noexcept { return issue_.status; }

 private:
  static std::string text_of(const tpa_issue& issue) {
    std::string text(tpa_issue_text(&issue, nullptr, 0) + 1, '\0');
    tpa_issue_text(&issue, &text[0], text.size());
    text.pop_back();
    return text;
  }
  tpa_issue issue_;
};

// A structure of topoadapt.h of zeros, with its size.
template <class Struct>
Struct make() {
  Struct s{};
  s.struct_size = sizeof(Struct);
  return s;
}

// Defaults of tpa_config_init. Limits are only where a mesh begins: it grows by itself.
inline tpa_config make_config(std::uint32_t max_vertices = 1024) {
  tpa_config config;
  tpa_config_init(&config, sizeof config);
  config.max_vertices = max_vertices;
  return config;
}

// Elements one after another, owned by somebody else: std::span for C++17.
template <class T>
class Span {
 public:
  Span() = default;
  Span(T* data, std::size_t size) : data_(data), size_(size) {}
  template <class Container, class = decltype(std::declval<Container&>().data())>
  Span(Container& container)  // as std::span: views of containers need no cast
      : data_(container.data()), size_(static_cast<std::size_t>(container.size())) {}

  T* data() const noexcept { return data_; }
  std::size_t size() const noexcept { return size_; }
  bool empty() const noexcept { return size_ == 0; }
  T& operator[](std::size_t i) const { return data_[i]; }
  T* begin() const noexcept { return data_; }
  T* end() const noexcept { return data_ + size_; }

 private:
  T* data_ = nullptr;
  std::size_t size_ = 0;
};

inline std::uint32_t checked_count(std::size_t count) {
  if (count > 0xFFFFFFFFu) throw std::length_error("topoadapt: more than 2^32 - 1 elements");
  return static_cast<std::uint32_t>(count);
}

// Triples of numbers in a container with data() and size(): of numbers, three for each element, or of types that begin
// with three of them, as std::array<float, 3> or a struct of a vector library with operator[].
template <class Number>
using IsReal = std::bool_constant<std::is_same_v<Number, float> || std::is_same_v<Number, double>>;
template <class Number>
using IsIndex = std::bool_constant<std::is_same_v<Number, std::uint16_t> || std::is_same_v<Number, std::uint32_t>>;

template <template <class> class Fits>
class Triples {
 public:
  template <class Container,
            class Element = std::remove_cv_t<std::remove_pointer_t<decltype(std::declval<const Container&>().data())>>>
  Triples(const Container& container) : data_(container.data()) {
    const std::size_t size = static_cast<std::size_t>(container.size());
    if constexpr (std::is_arithmetic_v<Element>) {
      set<Element>(size / 3, 3 * sizeof(Element));
      if (size % 3 != 0) throw std::invalid_argument("topoadapt: numbers do not come in threes");
    } else {
      set<std::decay_t<decltype(std::declval<const Element&>()[0])>>(size, sizeof(Element));
    }
  }
  template <class Number>
  Triples(const Number* numbers, std::size_t triples, std::size_t stride = 3 * sizeof(Number)) : data_(numbers) {
    set<Number>(triples, stride);
  }

  const void* data() const noexcept { return data_; }
  std::uint32_t count() const noexcept { return count_; }
  std::uint32_t stride() const noexcept { return stride_; }
  std::uint32_t type() const noexcept { return type_; }

 private:
  template <class Number>
  void set(std::size_t count, std::size_t stride) {
    static_assert(Fits<Number>::value, "positions are float or double, triangles uint16_t or uint32_t");
    count_ = checked_count(count);
    stride_ = checked_count(stride);
    type_ = std::is_same_v<Number, float>    ? TPA_FLOAT32
            : std::is_same_v<Number, double> ? TPA_FLOAT64
            : sizeof(Number) == 2            ? TPA_UINT16
                                             : TPA_UINT32;
  }
  const void* data_;
  std::uint32_t count_ = 0, stride_ = 0, type_ = 0;
};
using Positions = Triples<IsReal>;
using Triangles = Triples<IsIndex>;

// ---------------------------------------------------------------- components

// The components of a mesh, and the place in the list of each vertex.
struct Components {
  std::vector<tpa_component> list;
  std::vector<std::uint32_t> labels;

  std::size_t size() const noexcept { return list.size(); }
  const tpa_component& operator[](std::size_t i) const { return list[i]; }
  auto begin() const noexcept { return list.begin(); }
  auto end() const noexcept { return list.end(); }
  const tpa_component& of_vertex(std::size_t v) const { return list[labels[v]]; }
};

// Components before and after a commit that share vertices, or parents of vertices: a number of the family for each.
struct Families {
  std::vector<std::uint32_t> before, after;
  std::uint32_t count = 0;
};

// ---------------------------------------------------------------- the mesh

struct FreeBlock {
  void operator()(void* block) const noexcept { ::operator delete(block); }
};

class Mesh {
 public:
  // Without a mesh yet.
  explicit Mesh(const tpa_config& config) : config_(config) { allocate(config_, block_, context_); }
  Mesh(const Positions& positions, const Triangles& triangles) : Mesh(config_for(positions, triangles)) {
    load(positions, triangles);
  }
  Mesh(const Positions& positions, const Triangles& triangles, const tpa_config& config) : Mesh(config) {
    load(positions, triangles);
  }
  Mesh(Mesh&& other) noexcept { swap(other); }
  Mesh& operator=(Mesh&& other) noexcept {
    Mesh(std::move(other)).swap(*this);
    return *this;
  }
  Mesh(const Mesh&) = delete;
  Mesh& operator=(const Mesh&) = delete;
  ~Mesh() = default;
  void swap(Mesh& other) noexcept {
    std::swap(config_, other.config_);
    std::swap(block_, other.block_);
    std::swap(context_, other.context_);
    std::swap(most_bytes_, other.most_bytes_);
    std::swap(growths_, other.growths_);
  }
  // A mesh of the same state, to step back to.
  Mesh clone() const {
    Mesh copy;
    copy.config_ = config_;
    copy.most_bytes_ = most_bytes_;
    carry_over(config_, copy.block_, copy.context_);
    return copy;
  }

  void load(const Positions& positions, const Triangles& triangles) {
    tpa_mesh_input mesh = make<tpa_mesh_input>();
    mesh.vertex_count = positions.count();
    mesh.triangle_count = triangles.count();
    mesh.position_type = positions.type();
    mesh.index_type = triangles.type();
    mesh.position_stride = positions.stride();
    mesh.triangle_stride = triangles.stride();
    mesh.positions = positions.data();
    mesh.triangles = triangles.data();
    perform([&](tpa_issue* issue) { return tpa_load(context_, &mesh, issue); });
  }

  // ------------------------------------------------ work; all but move, detect and validate commit

  // Targets of the first vertices, or of vertices by id.
  void move(const Positions& targets) { move(targets, nullptr); }
  void move(const Positions& targets, Span<const std::uint32_t> vertices) {
    if (vertices.size() != targets.count()) throw std::invalid_argument("topoadapt: a target for each vertex id");
    if (!vertices.empty()) move(targets, vertices.data());
  }
  tpa_report step(const tpa_exec* exec = nullptr) {
    return report([&](tpa_report* r, tpa_issue* issue) { return tpa_step(context_, exec, r, issue); });
  }
  // Sub-steps whose limit is tpa_config.max_substeps, raised like all limits.
  tpa_report advance(double thickness, const tpa_exec* exec = nullptr) {
    return report([&](tpa_report* r, tpa_issue* issue) { return tpa_advance(context_, thickness, exec, r, issue); });
  }
  tpa_report adapt(const tpa_exec* exec = nullptr) {
    return report([&](tpa_report* r, tpa_issue* issue) { return tpa_adapt(context_, exec, r, issue); });
  }
  tpa_report remesh(const tpa_remesh_options& options, const tpa_exec* exec = nullptr) {
    return report([&](tpa_report* r, tpa_issue* issue) { return tpa_remesh(context_, &options, exec, r, issue); });
  }
  tpa_report remesh(double target_length, std::uint32_t iterations = 1, double relaxation = 0.5) {
    tpa_remesh_options options = make<tpa_remesh_options>();
    options.iterations = iterations;
    options.target_length = target_length;
    options.relaxation = relaxation;
    return remesh(options);
  }
  tpa_report smooth(const tpa_smooth_options& options, const tpa_exec* exec = nullptr) {
    return report([&](tpa_report* r, tpa_issue* issue) { return tpa_smooth(context_, &options, exec, r, issue); });
  }
  void reorder() {
    perform([&](tpa_issue* issue) { return tpa_reorder(context_, issue); });
  }
  Span<const tpa_contact> detect(const tpa_exec* exec = nullptr) {
    tpa_contacts contacts = make<tpa_contacts>();
    perform([&](tpa_issue* issue) { return tpa_detect(context_, exec, &contacts, issue); });
    return {contacts.pairs, contacts.count};
  }
  tpa_validation validate(const tpa_exec* exec = nullptr) {
    tpa_validation validation = make<tpa_validation>();
    perform([&](tpa_issue* issue) { return tpa_validate(context_, exec, &validation, issue); });
    return validation;
  }

  // ------------------------------------------------ the present mesh; empty before the first load

  tpa_mesh_view view() const {
    tpa_mesh_view view = make<tpa_mesh_view>();
    check_unless_empty(tpa_view(context_, &view));
    return view;
  }
  std::uint32_t vertex_count() const { return view().vertex_count; }
  std::uint32_t triangle_count() const { return view().triangle_count; }
  Span<const double> positions() const {  // x y z of each vertex
    const tpa_mesh_view v = view();
    return {v.positions, 3 * std::size_t{v.vertex_count}};
  }
  Span<const std::uint32_t> triangles() const {  // three ids of each triangle
    const tpa_mesh_view v = view();
    return {v.triangles, 3 * std::size_t{v.triangle_count}};
  }
  Components components() const {
    Components all;
    tpa_issue issue{};
    std::uint32_t count = 0;
    if (!check_unless_empty(tpa_components(context_, nullptr, 0, nullptr, &count, &issue), &issue)) return all;
    all.list.resize(count);
    all.labels.resize(vertex_count());
    check(tpa_components(context_, all.list.data(), count, all.labels.data(), &count, &issue), issue);
    return all;
  }

  // ------------------------------------------------ results of the last commit

  Span<const tpa_event> events() const {
    const tpa_event* events = nullptr;
    std::uint32_t count = 0;
    check(tpa_events(context_, &events, &count));
    return {events, count};
  }
  std::uint32_t count_events(tpa_event_type type) const {
    const Span<const tpa_event> all = events();
    return static_cast<std::uint32_t>(
        std::count_if(all.begin(), all.end(), [&](const tpa_event& e) { return e.type == type; }));
  }
  Span<const std::uint32_t> rolled_back() const {
    const std::uint32_t* vertices = nullptr;
    std::uint32_t count = 0;
    check(tpa_rolled_back(context_, &vertices, &count));
    return {vertices, count};
  }
  tpa_vertex_map_view vertex_map() const {
    tpa_vertex_map_view map = make<tpa_vertex_map_view>();
    check_unless_empty(tpa_vertex_map(context_, &map));
    return map;
  }
  tpa_triangle_map_view triangle_map() const {
    tpa_triangle_map_view map = make<tpa_triangle_map_view>();
    check_unless_empty(tpa_triangle_map(context_, &map));
    return map;
  }
  Span<const tpa_vertex_origin> vertex_origins() const {
    const tpa_vertex_map_view map = vertex_map();
    return {map.origins, map.new_count};
  }
  // With labels of the components before the commit (Components::labels).
  Families families(Span<const std::uint32_t> labels_before, const Components& now) const;

  // ------------------------------------------------ values that follow the last commit

  // Values of vertices, of any type. blend(a, b, weight) makes a value from weight of a and 1 - weight of b, for new
  // vertices alone; old vertices keep theirs. conserve(before, after) then corrects the values, such as their sum.
  template <class T, class Blend, class Conserve>
  void carry(std::vector<T>& values, Blend blend, Conserve conserve) const;
  template <class T, class Blend>
  void carry(std::vector<T>& values, Blend blend) const {
    carry(values, blend, [](Span<const T>, Span<T>) {});
  }
  // float and double as tpa_carry_vertices; other types want sums, and products with double.
  template <class T>
  void carry(std::vector<T>& values) const {
    if constexpr (IsReal<T>::value)
      carry_numbers<T>(values);
    else
      carry(values,
            [](const T& a, const T& b, double weight) { return static_cast<T>(weight * a + (1 - weight) * b); });
  }
  // Types that are float or double throughout, as colours and vectors.
  template <class Number, class T>
  void carry_numbers(std::vector<T>& values) const;
  // Values of triangles, of any type. A triangle of a handle or cap takes the value of the nearest triangle with an
  // origin; in a component without any origin, `fresh`.
  template <class T>
  void carry_triangles(std::vector<T>& values, const T& fresh = T()) const;

  // ------------------------------------------------ state and memory

  std::vector<std::uint8_t> save() const {
    std::size_t size = 0;
    tpa_issue issue{};
    const tpa_status status = tpa_save(context_, nullptr, 0, &size, &issue);
    if (status != TPA_E_ARENA) check(status, issue);
    std::vector<std::uint8_t> data(size);
    check(tpa_save(context_, data.data(), data.size(), &size, &issue), issue);
    return data;
  }
  void restore(Span<const std::uint8_t> data) {
    perform([&](tpa_issue* issue) { return tpa_restore(context_, data.data(), data.size(), issue); });
  }
  std::uint64_t digest() const {
    std::uint64_t digest = 0;
    check(tpa_digest(context_, &digest));
    return digest;
  }
  const tpa_config& config() const noexcept { return config_; }
  std::uint32_t growths() const noexcept { return growths_; }
  // A bound on the block in bytes: where a larger one would be needed, Error tells the limit. 0: none.
  void set_most_bytes(std::size_t most) noexcept { most_bytes_ = most; }
  // For functions of topoadapt.h. The address changes when the mesh grows.
  tpa_context* context() noexcept { return context_; }
  const tpa_context* context() const noexcept { return context_; }

 private:
  using Block = std::unique_ptr<void, FreeBlock>;

  Mesh() = default;

  static void check(tpa_status status, tpa_issue issue = {}) {
    if (status == TPA_OK) return;
    issue.status = status;
    throw Error(issue);
  }
  // Is there a mesh?
  static bool check_unless_empty(tpa_status status, const tpa_issue* issue = nullptr) {
    if (status != TPA_E_STATE) check(status, issue == nullptr ? tpa_issue{} : *issue);
    return status == TPA_OK;
  }
  static tpa_config config_for(const Positions& positions, const Triangles& triangles) {
    const std::uint64_t by_triangles = std::uint64_t{triangles.count()} / 2;
    const std::uint64_t wanted = 2 * std::max<std::uint64_t>({positions.count(), by_triangles, 512});
    return make_config(static_cast<std::uint32_t>(std::min<std::uint64_t>(wanted, 1u << 29)));
  }

  static Block make_block(const tpa_config& config, std::size_t& bytes) {
    tpa_arena_size size;
    tpa_issue issue{};
    check(tpa_arena_query(&config, &size, &issue), issue);
    bytes = size.bytes;
    return Block(::operator new(size.bytes));
  }
  static void allocate(const tpa_config& config, Block& block, tpa_context*& context) {
    std::size_t bytes;
    block = make_block(config, bytes);
    tpa_issue issue{};
    check(tpa_init(block.get(), bytes, &config, &context, &issue), issue);
  }
  void carry_over(const tpa_config& config, Block& block, tpa_context*& context) const {
    std::size_t bytes;
    block = make_block(config, bytes);
    tpa_issue issue{};
    check(tpa_grow(context_, block.get(), bytes, &config, &context, &issue), issue);
  }

  // Growth, in this place alone: a call that reaches a limit of the config has changed nothing; it is repeated in a
  // block with twice the limit, or with all that the call is known to need.
  template <class Call>
  void perform(Call call) {
    for (;;) {
      tpa_issue issue{};
      const tpa_status status = call(&issue);
      if (status != TPA_E_LIMIT || issue.argument != 0) return check(status, issue);
      grow(issue);
    }
  }
  void grow(const tpa_issue& issue) {
    tpa_config larger = config_;
    std::uint32_t* const limits[] = {nullptr,
                                     &larger.max_vertices,
                                     &larger.max_triangles,
                                     &larger.max_contacts,
                                     &larger.max_cut_edges,
                                     &larger.max_events,
                                     &larger.max_components,
                                     &larger.max_pieces,
                                     &larger.max_substeps};
    const std::uint64_t wanted = std::max(issue.needed, 2 * issue.available);
    if (issue.limit < TPA_LIMIT_VERTICES || issue.limit > TPA_LIMIT_SUBSTEPS || wanted > 0xFFFFFFFFu)
      throw Error(issue);
    *limits[issue.limit] = static_cast<std::uint32_t>(wanted);
    tpa_arena_size size;
    if (tpa_arena_query(&larger, &size, nullptr) != TPA_OK || (most_bytes_ != 0 && size.bytes > most_bytes_))
      throw Error(issue);
    Block block;
    tpa_context* context = nullptr;
    carry_over(larger, block, context);
    block_ = std::move(block);
    context_ = context;
    config_ = larger;
    ++growths_;
  }

  template <class Call>
  tpa_report report(Call call) {
    tpa_report report = make<tpa_report>();
    perform([&](tpa_issue* issue) { return call(&report, issue); });
    return report;
  }
  void move(const Positions& targets, const std::uint32_t* vertices) {
    tpa_move_input move = make<tpa_move_input>();
    move.count = targets.count();
    move.position_type = targets.type();
    move.position_stride = targets.stride();
    move.positions = targets.data();
    move.vertices = vertices;
    perform([&](tpa_issue* issue) { return tpa_move(context_, &move, issue); });
  }
  static void check_values(std::size_t values, std::uint32_t before) {
    if (values != before) throw std::invalid_argument("topoadapt: as many values as there were before the last commit");
  }

  tpa_config config_{};
  Block block_;
  tpa_context* context_ = nullptr;
  std::size_t most_bytes_ = 0;
  std::uint32_t growths_ = 0;
};

// ---------------------------------------------------------------- values that follow

template <class T, class Blend, class Conserve>
void Mesh::carry(std::vector<T>& values, Blend blend, Conserve conserve) const {
  check_values(values.size(), vertex_map().old_count);
  std::vector<T> after;
  after.reserve(vertex_count());
  for (const tpa_vertex_origin& o : vertex_origins()) {
    const T& first = values[o.parents[0]];
    if (o.parents[1] == TPA_NONE || o.parents[1] == o.parents[0] || o.weight >= 1)
      after.push_back(first);
    else if (o.weight > 0)
      after.push_back(blend(first, values[o.parents[1]], static_cast<double>(o.weight)));
    else
      after.push_back(values[o.parents[1]]);
  }
  conserve(Span<const T>(values), Span<T>(after));
  values.swap(after);
}

template <class Number, class T>
void Mesh::carry_numbers(std::vector<T>& values) const {
  static_assert(IsReal<Number>::value && std::is_trivially_copyable_v<T> && sizeof(T) % sizeof(Number) == 0,
                "a type of floats or doubles alone");
  check_values(values.size(), vertex_map().old_count);
  std::vector<T> after(vertex_count());
  constexpr std::uint32_t width = sizeof(T) / sizeof(Number);
  const Number* from = reinterpret_cast<const Number*>(values.data());
  Number* to = reinterpret_cast<Number*>(after.data());
  if constexpr (std::is_same_v<Number, float>)
    check(tpa_carry_vertices(context_, from, width, to));
  else
    check(tpa_carry_vertices_f64(context_, from, width, to));
  values.swap(after);
}

template <class T>
void Mesh::carry_triangles(std::vector<T>& values, const T& fresh) const {
  const tpa_triangle_map_view map = triangle_map();
  check_values(values.size(), map.old_count);
  // The library carries bits: of numbers of triangles, from 1.
  static_assert(sizeof(float) == sizeof(std::uint32_t), "bits of a number in a float");
  std::vector<float> before(map.old_count), source(map.new_count);
  for (std::uint32_t t = 0; t < map.old_count; ++t) {
    const std::uint32_t number = t + 1;
    std::memcpy(&before[t], &number, sizeof number);
  }
  check(tpa_carry_triangles(context_, before.data(), 1, source.data()));
  std::vector<T> after;
  after.reserve(map.new_count);
  for (const float& bits : source) {
    std::uint32_t number;
    std::memcpy(&number, &bits, sizeof number);
    after.push_back(number == 0 ? fresh : values[number - 1]);
  }
  values.swap(after);
}

inline Families Mesh::families(Span<const std::uint32_t> labels_before, const Components& now) const {
  check_values(labels_before.size(), vertex_map().old_count);
  const auto highest = std::max_element(labels_before.begin(), labels_before.end());
  const std::uint32_t old_count = labels_before.empty() ? 0 : *highest + 1;
  std::vector<std::uint32_t> root(old_count + now.size());
  for (std::uint32_t i = 0; i < root.size(); ++i) root[i] = i;
  const auto find = [&](std::uint32_t i) {
    while (root[i] != i) i = root[i] = root[root[i]];
    return i;
  };
  const Span<const tpa_vertex_origin> origins = vertex_origins();
  for (std::size_t v = 0; v < origins.size(); ++v)
    for (const std::uint32_t parent : origins[v].parents)
      if (parent != TPA_NONE) root[find(old_count + now.labels[v])] = find(labels_before[parent]);
  Families families;
  std::vector<std::uint32_t> number(root.size(), TPA_NONE);
  for (std::uint32_t i = 0; i < root.size(); ++i) {
    std::uint32_t& family = number[find(i)];
    if (family == TPA_NONE) family = families.count++;
    (i < old_count ? families.before : families.after).push_back(family);
  }
  return families;
}

// ---------------------------------------------------------------- conserved amounts of components

// An amount for each component, through merges and splits: components that merge add their amounts, and pieces share
// them. Amount has a default that is nothing, and +=. After each commit:
//     accounts.follow(mesh, measured, share)
// measured: what each present component measures; share(owned, part, whole): its share of what its family owned, for
// its part of what the family measures. The amounts are then what the values should sum up to.
template <class Amount>
class Accounts {
 public:
  Accounts(const Mesh& mesh, std::vector<Amount> amounts)
      : components_(mesh.components()), amounts_(std::move(amounts)) {
    if (amounts_.size() != components_.size()) throw std::invalid_argument("topoadapt: an amount for each component");
  }

  template <class Share>
  void follow(const Mesh& mesh, const std::vector<Amount>& measured, Share share);

  const Components& components() const noexcept { return components_; }
  const std::vector<Amount>& amounts() const noexcept { return amounts_; }
  // Of families without a component left.
  const Amount& lost() const noexcept { return lost_; }
  Amount total() const {
    Amount sum{};
    for (const Amount& a : amounts_) sum += a;
    return sum;
  }

 private:
  Components components_;
  std::vector<Amount> amounts_;
  Amount lost_{};
};

template <class Amount>
template <class Share>
void Accounts<Amount>::follow(const Mesh& mesh, const std::vector<Amount>& measured, Share share) {
  Components now = mesh.components();
  if (measured.size() != now.size()) throw std::invalid_argument("topoadapt: a measure for each component");
  const Families families = mesh.families(components_.labels, now);
  std::vector<Amount> owned(families.count, Amount{}), seen(families.count, Amount{}), after;
  std::vector<bool> lives(families.count, false);
  for (std::size_t b = 0; b < amounts_.size(); ++b) owned[families.before[b]] += amounts_[b];
  for (std::size_t b = 0; b < measured.size(); ++b) {
    seen[families.after[b]] += measured[b];
    lives[families.after[b]] = true;
  }
  for (std::size_t b = 0; b < measured.size(); ++b)
    after.push_back(share(owned[families.after[b]], measured[b], seen[families.after[b]]));
  for (std::size_t f = 0; f < owned.size(); ++f)
    if (!lives[f]) lost_ += owned[f];
  amounts_.swap(after);
  components_ = std::move(now);
}

}  // namespace topoadapt

#endif  // TOPOADAPT_HPP
