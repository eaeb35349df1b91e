// SPDX-License-Identifier: MIT
// contact_trial: brings the parts of a scene into contact, cuts them like the library, and finds the source of a handle
// that meets nothing. Uses the rooms of src/ directly.
#pragma once

#include <vector>

#include "contact_scenes.h"
#include "handle_choice.h"

namespace figures {

// Source of the new surface of a contact.
enum class Source { first_stored, later_stored, other_handle, nothing };

struct Trial {
  Loops loops;
  bool tabled = false;  // all loops have at most 15 vertices
  Source source = Source::nothing;
  bool agrees = true;  // where a stored handle is free, the library has joined the loops too
};

class Laboratory {
 public:
  Laboratory();
  // Each part comes in along its own direction until it meets an earlier part, and a little further.
  support::Mesh PushTogether(const Scene& scene);
  // Pushes the parts together, and judges the contacts with as many loops as the scene has parts. Without any such
  // contact, draw another scene.
  std::vector<Trial> Run(const Scene& scene);

 private:
  support::Arena arena_;
};

}  // namespace figures
