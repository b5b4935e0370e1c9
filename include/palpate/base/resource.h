// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

namespace palpate {

/// Resolves a resource name in a file to a path, without a check that the file exists.
///
///     /abs/file              as it is
///     file:///abs/file       /abs/file
///     rel/file, file://rel   relative to `relative_to_folder`
///     package://NAME/rest    rest in the folder of the ROS package NAME
///
/// A package is searched, in this order: upwards from `relative_to_folder` (a folder whose
/// package.xml has that name), in the entries of ROS_PACKAGE_PATH (the entry and folders up to
/// three levels below), in share/NAME of the entries of CMAKE_PREFIX_PATH, in /usr/share/NAME.
/// Paths may lead anywhere that the user may read; `rest` stays within the package, but links in
/// the package are followed.
/// @throws std::invalid_argument if the package is not found (with the searched places), `rest`
/// leaves the package, the name is empty or has a zero byte, or for another scheme.
std::string resolveResource(const std::string& uri, const std::string& relative_to_folder);

}  // namespace palpate
