// SPDX-License-Identifier: MIT
// Bytes as meshes: counts, types, strides, coordinates and indices of any value go to tpa_load. What is taken is
// detected, validated, adapted and stepped; what is refused leaves the mesh before as it was.
#include <cmath>
#include <cstring>
#include <limits>

#include "blocks.h"
#include "commit_judge.h"
#include "deed_source.h"
#include "oracle/commit_oracle.h"
#include "oracle/mesh_oracle.h"
#include "target.h"
#include "tool/surface.h"

namespace fuzz {

namespace {

using namespace support;

uint64_t inputs = 0, taken = 0, refused = 0;
Judged judged;

// Elements of three numbers each, as far apart as the stride says, in memory that ends with the last one.
class Rows {
 public:
  Rows(size_t count, size_t bytes, size_t stride) : stride_(stride == 0 ? bytes : stride) {
    memory_.resize(1 + (count == 0 ? 0 : (count - 1) * stride_ + bytes));
  }
  uint8_t* at(size_t i) { return memory_.data() + 1 + i * stride_; }  // at odd addresses

 private:
  std::vector<uint8_t> memory_;
  size_t stride_;
};

struct Input {
  tpa_mesh_input mesh = Sized<tpa_mesh_input>();
  Mesh truth;  // as the library is to read it
  Rows positions{0, 0, 0}, triangles{0, 0, 0};
};

double NumberFrom(Bytes& in) {
  const uint64_t bits = in.Wide();
  double x;
  switch (in.Below(8)) {
    case 0: std::memcpy(&x, &bits, sizeof x); return x;
    case 1: return std::ldexp(in.Around(1), static_cast<int>(in.Below(260)) - 130);
    case 2: return in.Once(2) ? std::numeric_limits<double>::quiet_NaN() : HUGE_VAL;
    case 3: return in.Once(2) ? std::numeric_limits<double>::denorm_min() : -0.;
    default: return static_cast<double>(bits % 16) - 8;
  }
}

// A closed surface with some changes, or nothing but bytes.
Mesh MeshOfBytes(Bytes& in) {
  Mesh m;
  if (in.Once(8)) {
    m.positions.resize(3 * size_t{in.Below(12)});
    m.triangles.resize(3 * size_t{in.Below(24)});
    for (double& x : m.positions) x = NumberFrom(in);
    for (uint32_t& v : m.triangles) v = in.Below(VertexCount(m) + (in.Once(16) ? 1000 : 0));
    return m;
  }
  m = MeshFrom(in);
  for (uint32_t i = in.Once(2) ? in.Below(4) : 0; i > 0; --i)
    m.positions[in.Below(static_cast<uint32_t>(m.positions.size()))] = NumberFrom(in);
  for (uint32_t i = in.Once(4) ? in.Below(4) : 0; i > 0; --i)
    m.triangles[in.Below(static_cast<uint32_t>(m.triangles.size()))] = in.Below(VertexCount(m) + 1);
  if (in.Once(16)) m.positions.insert(m.positions.end(), {0, 0, 0});
  if (in.Once(16)) m.triangles.insert(m.triangles.end(), m.triangles.begin(), m.triangles.begin() + 3);
  if (in.Once(16)) m.triangles.resize(m.triangles.size() - 3);
  return m;
}

template <class Number, class From>
void Fill(Rows& rows, std::vector<From>& numbers) {
  for (size_t i = 0; i < numbers.size(); ++i) {
    const auto number = static_cast<Number>(numbers[i]);
    std::memcpy(rows.at(i / 3) + i % 3 * sizeof number, &number, sizeof number);
    numbers[i] = static_cast<From>(number);
  }
}

// Beyond the range of floats only some conversions are defined.
bool HasFloats(const Mesh& m) {
  for (double x : m.positions)
    if (std::fabs(x) > static_cast<double>(std::numeric_limits<float>::max()) && !std::isinf(x)) return false;
  return true;
}

Input InputFrom(Bytes& in) {
  Input out;
  out.truth = MeshOfBytes(in);
  Mesh& m = out.truth;
  const bool is_single = in.Once(4) && HasFloats(m), is_short = in.Once(4);
  const uint32_t position_bytes = is_single ? 12 : 24, triangle_bytes = is_short ? 6 : 12;
  out.mesh.vertex_count = VertexCount(m);
  out.mesh.triangle_count = TriangleCount(m);
  out.mesh.position_type = is_single ? TPA_FLOAT32 : TPA_FLOAT64;
  out.mesh.index_type = is_short ? TPA_UINT16 : TPA_UINT32;
  out.mesh.position_stride = in.Once(2) ? position_bytes + in.Below(9) : 0;
  out.mesh.triangle_stride = in.Once(2) ? triangle_bytes + in.Below(9) : 0;
  out.positions = Rows(VertexCount(m), position_bytes, out.mesh.position_stride);
  out.triangles = Rows(TriangleCount(m), triangle_bytes, out.mesh.triangle_stride);
  is_single ? Fill<float>(out.positions, m.positions) : Fill<double>(out.positions, m.positions);
  is_short ? Fill<uint16_t>(out.triangles, m.triangles) : Fill<uint32_t>(out.triangles, m.triangles);
  out.mesh.positions = out.positions.at(0);
  out.mesh.triangles = out.triangles.at(0);
  return out;
}

// The first defect in the order of the header; those of edges and fans all count as TPA_DEFECT_ORIENTATION.
int32_t DefectOf(const Mesh& m) {
  for (double x : m.positions)
    if (!std::isfinite(x)) return TPA_DEFECT_NOT_FINITE;
  for (double x : m.positions)
    if (x != 0 && (std::fabs(x) > 0x1p100 || std::fabs(x) < 0x1p-100)) return TPA_DEFECT_MAGNITUDE;
  for (uint32_t v : m.triangles)
    if (v >= VertexCount(m)) return TPA_DEFECT_INDEX_RANGE;
  for (auto f = m.triangles.begin(); f != m.triangles.end(); f += 3)
    if (f[0] == f[1] || f[1] == f[2] || f[2] == f[0]) return TPA_DEFECT_REPEATED_VERTEX;
  return TopologyOf(m).defect.empty() ? TPA_DEFECT_NONE : TPA_DEFECT_ORIENTATION;
}

void JudgeLoad(const Input& input, const Owner& o, tpa_status status, const tpa_issue& issue) {
  const tpa_config config = ConfigOf(o.context);
  const Mesh& m = input.truth;
  const int32_t defect = DefectOf(m);
  if (VertexCount(m) < 4 || TriangleCount(m) < 4) {
    Demand(status == TPA_E_ARGUMENT, "fewer than four vertices or triangles are refused");
  } else if (VertexCount(m) > config.max_vertices || status == TPA_E_LIMIT) {
    Demand(status == TPA_E_LIMIT && issue.needed > issue.available, "what does not fit is refused");
  } else {
    Demand(status == (defect == TPA_DEFECT_NONE ? TPA_OK : TPA_E_MESH) &&
               (issue.defect == defect || (defect >= TPA_DEFECT_ORIENTATION && issue.defect > defect)),
           "defect ", defect, " is told, not ", issue.defect, ", ", tpa_status_string(status));
  }
  if (status == TPA_OK)
    Demand(Differing(MeshOf(o.context).positions, m.positions).empty(), "the mesh is the one given");
}

// Values that no version knows.
void Spoil(Bytes& in, tpa_mesh_input& mesh, bool& is_bad) {
  is_bad = true;
  switch (in.Below(64)) {
    case 0: mesh.position_type = TPA_UINT16 + in.Below(3); break;
    case 1: mesh.index_type = in.Below(3); break;
    case 2: mesh.position_stride = 1 + in.Below(11); break;
    case 3: mesh.triangle_stride = 1 + in.Below(5); break;
    case 4: mesh.positions = nullptr; break;
    case 5: mesh.triangles = nullptr; break;
    case 6: mesh.vertex_count = in.Below(4); break;
    case 7: mesh.triangle_count = in.Below(4); break;
    default: is_bad = false;
  }
}

void Work(Bytes& in, const Owner& o) {
  JudgeMesh(o.context, judged);
  JudgeDetection(o.context, {}, judged);
  for (DeedKind kind : {DeedKind::adapt, DeedKind::step}) {
    const Deed deed(kind);
    const Before before(o.context);
    const uint64_t digest = DigestOf(o.context);
    const Outcome done = Do(deed, o.context);
    Trace(NameOf(kind) + ": " + Text(done));
    if (done.status != TPA_OK) {
      Demand(done.digest == digest &&
                 (done.status == TPA_E_LIMIT || (kind == DeedKind::step && done.status == TPA_E_TANGLED)),
             "a failure changes nothing, and is one of room or of a tangle: ", Text(done));
      return;
    }
    JudgeCommit(deed, before, done, kind == DeedKind::adapt && done.report.unresolved == 0, o.context, judged);
    JudgeMesh(o.context, judged);
    if (in.Once(2)) return;
  }
}

}  // namespace

std::string Tally() {
  return tool::text_of(inputs, " inputs, ", taken, " meshes taken, ", refused, " refused; judged: ", judged.pairs,
                       " pairs, ", judged.events, " events, ", judged.regions, " regions");
}

bool ReachedEnough(uint64_t of) { return 4 * taken > of && 4 * refused > of && judged.pairs > of; }

}  // namespace fuzz

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace fuzz;
  Bytes in{data, size};
  tpa_config config = ConfigFrom(in);
  config.region = TPA_REGION_INSIDE;
  const Owner o = Made(config);
  const Mesh ball = Sphere({}, 1, 1);
  const tpa_mesh_input small = tool::input_of(ball);
  const bool is_loaded = tpa_load(o.context, &small, nullptr) == TPA_OK;
  Demand(is_loaded || config.max_vertices < 6 || config.max_triangles < 8, "a small ball is taken");
  const uint64_t digest = DigestOf(o.context);
  Input input = InputFrom(in);
  bool is_bad = false;
  Spoil(in, input.mesh, is_bad);
  tpa_issue issue;
  const tpa_status status = tpa_load(o.context, &input.mesh, &issue);
  ++inputs;
  if (is_bad)
    Demand(status == TPA_E_ARGUMENT && issue.argument == 2, "an argument at fault is refused");
  else
    JudgeLoad(input, o, status, issue);
  ++(status == TPA_OK ? taken : refused);
  if (status == TPA_OK)
    Work(in, o);
  else
    Demand(DigestOf(o.context) == digest, "a mesh that is refused changes nothing");
  return 0;
}
