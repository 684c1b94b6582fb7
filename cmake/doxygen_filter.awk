# SPDX-License-Identifier: Apache-2.0
# Shows Doxygen a header as its reader sees it: the comment at its head is the description of the
# file, and that of voxelume.hpp the main page. An empty line makes room for what is added, so that
# warnings have the header's own line numbers.
FNR == 1 {
    in_head = 1
    is_main = FILENAME ~ /\/voxelume\.hpp$/
    if (is_main) print "/// \\mainpage The library"; else print "/// \\file"
    surplus = 1
}
in_head && !/^\/\// {
    in_head = 0
    if (is_main) {
        print "/// \\namespace voxelume The library."
        print "/// \\namespace voxelume::v1 Its names, in the version of its interface."
    }
}
in_head && /SPDX-License-Identifier/ { print ""; next }
in_head { sub(/^\/\//, "///") }
surplus > 0 && /^$/ { --surplus; next }
{ print }
