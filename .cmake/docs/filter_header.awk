# SPDX-License-Identifier: MIT
# What Doxygen reads of a header: awk -f filter_header.awk include/moreau/<folder>/<name>.hpp
#
#  - All names of a public header are in the group of its folder (folders.dox), so headers need no line for it.
#    Headers in folders named detail/ and in private sub-folders are in no group.
#  - Specialisations of variables are left out: their primary has the description.
#  - The short names that every class has for the types of its space are left out: conventions.md has them.
#  - "this file" becomes its path, which Doxygen makes a link to the listing.
#  - Of a program of the examples nothing is read: Doxygen lists its source, to which pages link.
#
# The number of lines stays the same, so that warnings name the right line.
BEGIN {
  short_names = "Space|S|Scalar|Vector|Matrix|Angular|Inertia|Twist|Lever|Rotation|Options|Tangent|W|Values|" \
    "PaddedTwist|Types|Sample|Edge|Coupling|Cells|FaceOffsets"
}
# A line up to its first parenthesis.
function declarator(line) {
  sub(/\(.*/, "", line)
  return line
}
FNR == 1 {
  program = FILENAME !~ /include\/moreau\//
  path = FILENAME
  sub(/.*include\//, "", path)
  folder = FILENAME
  is_private = folder ~ /\/detail\/|\/detect\/(convex|polytope|pairs)\/|\/solve\/coloured\//
  sub(/.*include\/moreau\//, "", folder)
  folder = folder ~ /\// && !is_private ? substr(folder, 1, index(folder, "/") - 1) : ""
  begin = " /** @addtogroup " folder " */ /** @{ */"
  end = "/** @} */ "
}
program { print ""; next }
/^ *\/\/\/ / { gsub(/this file/, path) }
# The lines "template <...>" and "requires ..." above a name.
/^template </ || (head && /^ /) { head = head $0 "\n"; next }
head && /^inline constexpr [a-z]+ [a-z_]+<.*> = .*;$/ { gsub(/[^\n]+/, "", head); $0 = "" }
# The definition of a member outside its class belongs to the class and not to the group.
folder && /^[A-Za-z].*[{,]$/ && declarator($0) ~ /[A-Za-z0-9>]::~?[A-Za-z_]+$/ { head = end head; member = 1 }
member && /^\}$/ { $0 = $0 begin; member = 0 }
{ printf "%s", head; head = "" }
$0 ~ "^ +using (" short_names ") = .*;( *//.*)?$" { print ""; next }
folder && /^namespace moreau[a-z_:]* \{/ { print $0 begin; next }
folder && /^\}  \/\/ namespace moreau/ { print end $0; next }
{ print }
