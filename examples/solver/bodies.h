// SPDX-License-Identifier: MIT
// Conserved amounts of each body, through all events. Interpolated values of new vertices do not conserve sums; so each
// body has an account, and values are corrected by it.
#ifndef SOLVER_BODIES_H
#define SOLVER_BODIES_H

#include "surface.h"

namespace solver {

struct Account {
  double volume = 0, surfactant = 0;
  Account& operator+=(const Account& other) {
    volume += other.volume;
    surfactant += other.surfactant;
    return *this;
  }
};
using Bodies = topoadapt::Accounts<Account>;

// Of each body. `surfactant` is a concentration, one for each vertex.
std::vector<Account> measure(const Surface& surface, const std::vector<double>& surfactant);
// After each commit, with data that have followed: moves the accounts along, and corrects concentrations.
void follow(const Surface& surface, Bodies& bodies, std::vector<double>& surfactant);
// Moves targets along their normals until each body encloses the volume of its account.
void keep_volumes(const Surface& surface, const Bodies& bodies, Points& targets);

}  // namespace solver

#endif
