// SPDX-License-Identifier: MIT
// stack_usage LIMIT RELOCATIONS GRAPH...
// Bounds the stack of each function tpa_...: the deepest path in the call graphs of GCC (-fcallgraph-info=su), with the
// frames of each function. RELOCATIONS is the output of `objdump -r` for the same objects, compiled with
// -ffunction-sections: it tells where addresses of functions are taken. Fails above LIMIT bytes, for recursion, for
// frames without a bound, and for indirect calls of a kind unknown here.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace {

using Names = std::set<std::string>;

[[noreturn]] void refuse(const std::string& why) {
  std::cerr << "stack_usage: " << why << '\n';
  std::exit(1);
}

// Functions of the C library and of the compiler's own, without a frame in the graphs.
constexpr long outside = 128;

// A kind of indirect call: the source files with such calls, and the names of all functions called there.
struct Kind {
  std::regex site, callee;
  enum { here, below, later } called;  // by the taker of the address, by a function it calls, or after its return
};
const Kind kinds[] = {
    {std::regex("base/parallel\\.h"), std::regex("10for_chunksI.*_FUNE"), Kind::here},
    {std::regex("detect/face_tree_search\\.cpp"), std::regex("(18for_each_leaf_near|13search_leaves)I.*_FUNE"),
     Kind::below},
    {std::regex("detect/near_faces\\.cpp"), std::regex("(17near_faces_detail6asking|16find_near_within)I.*_FUNE"),
     Kind::below},
    {std::regex("edit/remesh\\.cpp"), std::regex("_edgeERNS0_8RemesherE[jm]"), Kind::below},
    {std::regex("triangulate/candidates\\.cpp"), std::regex("[0-9]draw_"), Kind::later},
    {std::regex("triangulate/(face_filter\\.h|minimum_triangulation\\.cpp)"), std::regex("12face_is_free"),
     Kind::below},
};
constexpr int none = -1;

int kind_of(const std::string& title) {
  for (size_t i = 0; i < std::size(kinds); ++i)
    if (std::regex_search(title, kinds[i].callee)) return static_cast<int>(i);
  return none;
}
int kind_of_site(const std::string& place) {
  for (size_t i = 0; i < std::size(kinds); ++i)
    if (std::regex_search(place, kinds[i].site)) return static_cast<int>(i);
  refuse("an indirect call of an unknown kind at " + place);
}

struct Function {
  long frame = outside;
  bool is_known = false;
  Names calls;
  std::set<int> kinds_called;
  Names taken;  // functions with an address taken here
};

struct Graph {
  std::map<std::string, Function> functions;
  std::map<std::string, std::map<std::string, std::string>> titles;  // by object, by symbol
};

// "folder/name" of a path that ends with a file's name and suffixes: the same for an object and its graph.
std::string stem_of(const std::string& path) {
  const size_t name = path.rfind('/'), folder = path.rfind('/', name - 1);
  return path.substr(folder + 1, path.find('.', name) - folder - 1);
}

std::string quoted_after(const std::string& line, const std::string& key) {
  const size_t at = line.find(key + ": \"");
  if (at == std::string::npos) return {};
  const size_t begin = at + key.size() + 3;
  return line.substr(begin, line.find('"', begin) - begin);
}

void read_node(const std::string& line, std::map<std::string, std::string>& titles, Graph& graph) {
  static const std::regex frame("\\\\n([0-9]+) bytes \\(([a-z,]+)\\)");
  const std::string title = quoted_after(line, "title"), label = quoted_after(line, "label");
  std::smatch found;
  if (!std::regex_search(label, found, frame)) return;
  if (found[2] == "dynamic") refuse("a frame without a bound: " + label);
  Function& f = graph.functions[title];
  f.frame = f.is_known ? std::max(f.frame, std::stol(found[1])) : std::stol(found[1]);
  f.is_known = true;
  titles[title.substr(title.rfind(':') + 1)] = title;
}

void read_graph(const std::string& path, Graph& graph) {
  std::ifstream file(path);
  if (!file) refuse("no file " + path);
  auto& titles = graph.titles[stem_of(path)];
  for (std::string line; std::getline(file, line);) {
    if (line.rfind("node:", 0) == 0) read_node(line, titles, graph);
    if (line.rfind("edge:", 0) != 0) continue;
    Function& f = graph.functions[quoted_after(line, "sourcename")];
    const std::string target = quoted_after(line, "targetname");
    if (target == "__indirect_call")
      f.kinds_called.insert(kind_of_site(quoted_after(line, "label")));
    else
      f.calls.insert(target);
  }
}

// ---------------------------------------------------------------- addresses taken

// The symbol of a section name or relocation, without addends and parts split off.
std::string symbol_of(std::string name) {
  static const std::regex text("^\\.text(\\.(unlikely|hot|startup|exit))?\\."), rest("([-+]0x[0-9a-f]+|@.*|\\.cold)+$");
  name = std::regex_replace(name, rest, "");
  return std::regex_replace(name, text, "");
}

// References between the sections of an object: by name of a function, or of a section of data.
struct References {
  std::map<std::string, Names> from;
};

// A call within an object has the same relocation as an address.
void note_address(Function& f, const std::string& title, const std::string& of) {
  if (of != title && (f.calls.count(of) == 0 || kind_of(of) != none)) f.taken.insert(of);
}

void take_addresses(const std::string& object, const References& references, Graph& graph) {
  if (object.empty()) return;
  if (graph.titles.count(object) == 0) refuse("no graph of " + object);
  const auto& titles = graph.titles[object];
  for (const auto& [section, first] : references.from) {
    const auto function = titles.find(section);
    if (function == titles.end()) continue;
    Names seen, rest = first;
    while (!rest.empty()) {
      const std::string symbol = *rest.begin();
      rest.erase(rest.begin());
      if (!seen.insert(symbol).second) continue;
      const auto taken = titles.find(symbol);
      if (taken != titles.end()) {
        note_address(graph.functions[function->second], function->second, taken->second);
      } else if (const auto data = references.from.find(symbol); data != references.from.end()) {
        rest.insert(data->second.begin(), data->second.end());
      }
    }
  }
}

void read_relocations(const std::string& path, Graph& graph) {
  static const std::regex call("PLT|CALL|JUMP|JMP|PC24|BRANCH|RELAX");
  std::ifstream file(path);
  if (!file) refuse("no file " + path);
  std::string object, section;
  References references;
  for (std::string line; std::getline(file, line);) {
    if (line.find("file format") != std::string::npos) {
      take_addresses(object, references, graph);
      references = {};
      object = stem_of(line);
    } else if (line.rfind("RELOCATION RECORDS FOR [", 0) == 0) {
      section = symbol_of(line.substr(24, line.rfind(']') - 24));
    } else {
      char type[64], value[4096];
      if (std::sscanf(line.c_str(), "%*x %63s %4095s", type, value) != 2) continue;
      if (!std::regex_search(type, call)) references.from[section].insert(symbol_of(value));
    }
  }
  take_addresses(object, references, graph);
}

// ---------------------------------------------------------------- depths

struct Depth {
  long bytes = none;  // none: no such path
  std::vector<std::string> path;
};

Depth on_top(const std::string& title, long frame, const Depth& above) {
  Depth d{frame + above.bytes, {title}};
  d.path.insert(d.path.end(), above.path.begin(), above.path.end());
  return d;
}
void keep_deeper(Depth& d, Depth other) {
  if (other.bytes > d.bytes) d = std::move(other);
}

class Search {
 public:
  explicit Search(const Graph& graph) : graph_(graph) {}

  // Bytes from the entry of a function to the end of its deepest path.
  const Depth& whole(const std::string& title) {
    const auto [at, is_new] = whole_.try_emplace(title);
    if (!is_new) {
      if (at->second.bytes == none) refuse("recursion through " + title);
      return at->second;
    }
    const Function& f = function(title);
    Depth deepest{f.frame, {title}};
    for (const std::string& g : f.calls) keep_deeper(deepest, on_top(title, f.frame, whole(g)));
    for (int kind : f.kinds_called)
      if (kinds[kind].called == Kind::later)
        for (const std::string& g : stored(kind)) keep_deeper(deepest, on_top(title, f.frame, whole(g)));
    for (const std::string& g : f.taken) keep_deeper(deepest, called_back(title, g));
    return whole_[title] = deepest;
  }

 private:
  const Function& function(const std::string& title) {
    static const Function unknown;
    const auto at = graph_.functions.find(title);
    return at == graph_.functions.end() ? unknown : at->second;
  }

  Names stored(int kind) {
    Names all;
    for (const auto& [title, f] : graph_.functions)
      if (f.is_known && kind_of(title) == kind) all.insert(title);
    return all;
  }

  // The deepest path to an indirect call of a kind.
  const Depth& open(const std::string& title, int kind) {
    const auto [at, is_new] = open_.try_emplace({title, kind});
    if (!is_new) return at->second;
    const Function& f = function(title);
    Depth deepest;
    if (f.kinds_called.count(kind) != 0) deepest = {f.frame, {title}};
    const auto go_on = [&](const std::string& g) {
      const Depth& above = open(g, kind);
      if (above.bytes != none) keep_deeper(deepest, on_top(title, f.frame, above));
    };
    if (kinds[kind].called == Kind::here) return open_[{title, kind}] = deepest;
    for (const std::string& g : f.calls) go_on(g);
    for (int called : f.kinds_called)
      if (kinds[called].called == Kind::later)
        for (const std::string& g : stored(called)) go_on(g);
    for (const std::string& taken : f.taken) {
      const Depth& above = open(taken, kind);
      if (above.bytes == none) continue;
      Depth below = open(title, kind_of(taken));
      below.bytes += above.bytes;
      below.path.insert(below.path.end(), above.path.begin(), above.path.end());
      keep_deeper(deepest, below);
    }
    return open_[{title, kind}] = deepest;
  }

  // A function whose address is taken in `title` runs on top of a call below.
  Depth called_back(const std::string& title, const std::string& taken) {
    const int kind = kind_of(taken);
    if (kind == none) refuse(title + " takes the address of " + taken + ", of an unknown kind");
    if (kinds[kind].called == Kind::later) return {};
    Depth below = open(title, kind);
    if (below.bytes == none) refuse(title + " takes the address of " + taken + " and nothing below calls it");
    const Depth& above = whole(taken);
    below.bytes += above.bytes;
    below.path.insert(below.path.end(), above.path.begin(), above.path.end());
    return below;
  }

  const Graph& graph_;
  std::map<std::string, Depth> whole_;
  std::map<std::pair<std::string, int>, Depth> open_;
};

}  // namespace

int main(int count, char** argument) {
  if (count < 4) refuse("LIMIT RELOCATIONS GRAPH...");
  const long limit = std::atol(argument[1]);
  Graph graph;
  for (int i = 3; i < count; ++i) read_graph(argument[i], graph);
  read_relocations(argument[2], graph);
  Search search(graph);
  long deepest = 0, functions = 0;
  for (const auto& [title, f] : graph.functions) {
    if (title.rfind("tpa_", 0) != 0 || !f.is_known) continue;
    const Depth& depth = search.whole(title);
    deepest = std::max(deepest, depth.bytes), ++functions;
    std::cout << depth.bytes << ' ' << title << '\n';
    if (depth.bytes > limit)
      for (const std::string& g : depth.path) {
        const auto at = graph.functions.find(g);
        std::cout << "    " << (at == graph.functions.end() ? outside : at->second.frame) << ' ' << g << '\n';
      }
  }
  std::cout << "deepest: " << deepest << " bytes of " << limit << ", " << functions << " functions\n";
  if (functions == 0) refuse("no function tpa_... in the graphs");
  return deepest > limit ? 1 : 0;
}
