// SPDX-License-Identifier: MIT
// Conserved amounts of each body, through all events. Interpolated values of new vertices do not conserve sums; so each
// body has an account, and values are corrected by it. Bodies that merge add their accounts; pieces of a body share its
// account in proportion to what they measure.
#ifndef SOLVER_BODIES_H
#define SOLVER_BODIES_H

#include "surface.h"

namespace solver {

struct Account {
  double volume = 0, surfactant = 0;
};

class Bodies {
 public:
  // Opens accounts with what is measured. `surfactant` is a concentration, one for each vertex.
  Bodies(const Surface& surface, const std::vector<double>& surfactant);

  // After each commit, with data that have followed: moves the accounts along, and corrects concentrations.
  void follow(const Surface& surface, std::vector<double>& surfactant);

  // Moves targets along their normals until each body encloses the volume of its account.
  void keep_volumes(const Surface& surface, Points& targets) const;

  const std::vector<Account>& accounts() const { return accounts_; }
  // Of bodies that are gone.
  const Account& lost() const { return lost_; }
  Account total() const;

 private:
  std::vector<uint32_t> labels_;  // place in accounts_ of each vertex
  std::vector<Account> accounts_;
  Account lost_;
};

}  // namespace solver

#endif
