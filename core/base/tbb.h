// SPDX-License-Identifier: MIT
#pragma once

// TBB has functions called emit, Qt a macro of that name, and programs may include Qt first: TBB of Debian 12
// does not look after that itself. Headers include TBB from here.
#pragma push_macro("emit")
#undef emit
#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>
#include <tbb/parallel_sort.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>
#pragma pop_macro("emit")
