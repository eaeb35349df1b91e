// SPDX-License-Identifier: MIT
#include "cut/union_order.h"

namespace tpa {

namespace {

// Components connected with a cavity by contacts do not wait either.
void spread_cavities(const Mesh& m, Span<const Contact> contacts, Components& c) {
  for (u32 i = 0; i < c.list.size; ++i) c.list[i].family = i;
  for (const Contact& pair : contacts)
    unite_families(c, component_of(c, m.corner[3 * pair.a]), component_of(c, m.corner[3 * pair.b]));
  for (u32 i = 0; i < c.list.size; ++i)
    if (c.list[i].turn == Turn::cavity) c.list[find_family(c, i)].turn = Turn::cavity;
  for (u32 i = 0; i < c.list.size; ++i)
    if (c.list[find_family(c, i)].turn == Turn::cavity) c.list[i].turn = Turn::cavity;
  for (Component& part : c.list) part.family = none;
}

}  // namespace

bool choose_waiting(const Mesh& m, Span<const Contact> contacts, Components& c, u8* mark, Stack<u32>& queue) {
  const auto of_face = [&](u32 f) -> Component& { return c.list[component_of(c, m.corner[3 * f])]; };
  for (Component& part : c.list) part.turn = Turn::first;
  for (const Contact& pair : contacts)
    if (&of_face(pair.a) != &of_face(pair.b)) of_face(pair.a).turn = of_face(pair.b).turn = Turn::waits;
  for (Component& part : c.list) {
    if (part.turn != Turn::waits) continue;
    collect_component(m, part.id, mark, queue);
    if (volume_of_component(m, queue.span()).sum < 0) part.turn = Turn::cavity;
  }
  spread_cavities(m, contacts, c);
  bool any = false;
  for (const Component& part : c.list) any = any || part.turn == Turn::waits;
  return any;
}

}  // namespace tpa
