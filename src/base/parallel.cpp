// SPDX-License-Identifier: MIT
#include "base/parallel.h"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

namespace plumb {

void parallel_for(std::size_t count, int threads, const std::function<void(std::size_t)>& part)
{
    if (count == 1) return part(0); // no threads to be woken
    const int used = threads > 0 ? threads : oneapi::tbb::info::default_concurrency();
    const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism,
                                            static_cast<std::size_t>(used));
    oneapi::tbb::task_arena arena(used);
    arena.execute([&] { oneapi::tbb::parallel_for(std::size_t{0}, count, part); });
}

} // namespace plumb
