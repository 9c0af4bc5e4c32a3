// SPDX-License-Identifier: MIT
#pragma once

// TBB has functions called emit, Qt a macro of that name, and programs may include Qt first: TBB of Debian 12
// does not look after that itself.
#pragma push_macro("emit")
#undef emit
#include <tbb/task_arena.h>
#include <tbb/task_group.h>
#pragma pop_macro("emit")
