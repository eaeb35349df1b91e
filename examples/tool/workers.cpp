// SPDX-License-Identifier: MIT
#include "tool/workers.h"

#ifdef TOOL_HAVE_POOL
#include "pool.h"
#endif

namespace tool {

struct Workers::Pool {
#ifdef TOOL_HAVE_POOL
  ::Pool* pool;
  explicit Pool(int threads) : pool(pool_start(threads)) {}
  ~Pool() {
    if (pool != nullptr) pool_stop(pool);
  }
#endif
};

Workers::Workers([[maybe_unused]] int threads) {
#ifdef TOOL_HAVE_POOL
  if (threads < 2) return;
  pool_ = std::make_unique<Pool>(threads);
  if (pool_->pool != nullptr) exec_ = pool_exec(pool_->pool);
#endif
}

Workers::~Workers() = default;

void Workers::for_each(uint32_t count, const std::function<void(uint32_t)>& work) const {
  if (exec_.parallel_for == nullptr) {
    for (uint32_t i = 0; i < count; ++i) work(i);
    return;
  }
  const auto call = [](void* data, uint32_t i) { (*static_cast<const std::function<void(uint32_t)>*>(data))(i); };
  exec_.parallel_for(exec_.user, count, call, const_cast<void*>(static_cast<const void*>(&work)));
}

}  // namespace tool
