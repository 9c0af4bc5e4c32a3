# SPDX-License-Identifier: MIT
# The libraries that core is linked with: found here when Relucent is built, and again, from the installed copy of this
# file, by every project that finds Relucent, as its libraries are static.
find_package(TBB REQUIRED)
find_package(fmt REQUIRED)
find_package(Eigen3 REQUIRED)
find_package(OpenEXR REQUIRED)
# Named one by one: the catch-all list brings highgui, which is Qt 5.
find_package(OpenCV REQUIRED COMPONENTS core imgproc imgcodecs videoio)
find_package(nlohmann_json REQUIRED)
find_package(CLI11 REQUIRED)
# Embree 3 or 4, whichever the distribution has; both call their package and their target the same.
find_package(embree REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(XXHASH REQUIRED IMPORTED_TARGET libxxhash)
pkg_check_modules(BLOSC REQUIRED IMPORTED_TARGET blosc)
pkg_check_modules(LIBZIP REQUIRED IMPORTED_TARGET libzip)
pkg_check_modules(EPOXY REQUIRED IMPORTED_TARGET epoxy)
pkg_check_modules(GIO REQUIRED IMPORTED_TARGET gio-2.0)
# Cameras: without these everything else works, and `relucent-cli devices` says what is missing. A project that finds
# Relucent needs those that it was built with.
pkg_check_modules(ARAVIS IMPORTED_TARGET aravis-0.8>=0.8.26)
pkg_check_modules(LIBRAW IMPORTED_TARGET libraw_r)
pkg_check_modules(GPHOTO2 IMPORTED_TARGET libgphoto2>=2.5.10)
