# SPDX-License-Identifier: MIT
# What Doxygen reads of a page: awk -f filter_page.awk examples/guide/<name>.md
#
# Pages are written for a Git host. There a heading is the target of links by its text, and a link is a path from
# the folder of the page. Doxygen 1.9 knows neither, so this filter
#
#  - gives page.md the name page, folder/README.md the name folder, and the heading "A b" of page.md the name
#    page-a-b,
#  - turns a link to a page or to a heading into a reference,
#  - turns a link to another file of the examples into a link to its listing, where there is one; of any other
#    file it leaves the path, as text,
#  - leaves the name of a picture: IMAGE_PATH has the folders,
#  - makes names of public types in code links to their reference.
#
# The number of lines stays the same, so that warnings name the right line.

# The name of a page of the site; "" for every other path from the folder of the project.
function name_of(path) {
  if (path == "examples/guide/README.md" || path == "examples/guide") return "index"
  if (path == "examples" || path == "examples/README.md") return "examples"
  sub(/\/README\.md$/, "", path)
  if (path ~ /^examples\/guide\/[^\/]+\.md$/ || path ~ /^examples\/(contact_dynamics_vs_springs|plane_and_space|ratcheting|validation)$/) {
    sub(/.*\//, "", path)
    sub(/\.md$/, "", path)
    return path
  }
  return ""
}
# A path without "x/../".
function plain(path) {
  while (match(path, /[^\/.]+\/\.\.\//)) path = substr(path, 1, RSTART - 1) substr(path, RSTART + RLENGTH)
  sub(/\/$/, "", path)
  return path
}
function anchor_of(heading) {
  heading = tolower(heading)
  gsub(/`/, "", heading)
  gsub(/[^a-z0-9_ -]/, "", heading)
  gsub(/ /, "-", heading)
  return heading
}
# The listing of a source of the examples, by the rule by which Doxygen names it.
function listing_of(path) {
  if (path !~ /^examples\/[a-z_]+\/[a-z_]+\.[ch]pp$/ || path ~ /^examples\/(ratcheting|validation)\/|\/main\.cpp$/) return ""
  sub(/.*\//, "", path)
  gsub(/_/, "__", path)
  gsub(/\./, "_8", path)
  return path "_source.html"
}
function reference(text, link,   hash, anchor, path, name, listing) {
  if (link ~ /^[a-z]+:/) return "[" text "](" link ")"
  hash = index(link, "#")
  anchor = hash ? substr(link, hash + 1) : ""
  path = hash == 1 ? page : plain(folder (hash ? substr(link, 1, hash - 1) : link))
  name = name_of(path)
  if (name) return "[" text "](@ref " name (anchor ? "-" anchor : "") ")"
  listing = listing_of(path)
  if (listing) return "<a href=\"" listing "\">" text "</a>"
  return text == path ? text : text " (`" path "`)"
}

# A text whose names of public types are links: `Name` and `Name<...>`.
function linked(text,   out, found, name) {
  while (match(text, /`[A-Z][A-Za-z]+(<[^`]*>)?`/)) {
    found = substr(text, RSTART, RLENGTH)
    out = out substr(text, 1, RSTART - 1)
    text = substr(text, RSTART + RLENGTH)
    name = found
    gsub(/`|<.*/, "", name)
    if (name in is_type) {
      gsub(/`/, "", found)
      gsub(/</, "\\&lt;", found)
      gsub(/>/, "\\&gt;", found)
      found = "<code>@ref moreau::" name " \"" found "\"</code>"
    }
    out = out found
  }
  return out text
}

BEGIN {
  list = "find include/moreau -name '*.hpp' | grep -Ev '/detail/|/detect/(convex|polytope|pairs)/|/solve/coloured/' | " \
    "xargs awk '/^namespace/ { ++depth; if (!skip && /detail|rendering/) skip = depth } " \
    "/^}  \\/\\/ namespace/ { if (skip == depth--) skip = 0 } !skip' | " \
    "grep -oE '^(.*[>)] )?(class|struct|concept|using) [A-Z][A-Za-z]+' | grep -vE '^ *//|^ +using'"
  while ((list | getline declaration) > 0) {
    sub(/.* /, "", declaration)
    is_type[declaration] = 1
  }
  close(list)
}
FNR == 1 {
  page = FILENAME
  sub(/.*\/examples\//, "examples/", page)
  folder = page
  sub(/[^\/]*$/, "", folder)
}
/^ *```/ { fenced = !fenced }
fenced { print; next }
/^# / { print name_of(page) == "index" ? $0 : $0 " {#" name_of(page) "}"; next }
/^##+ / {
  title = $0
  sub(/^#+ /, "", title)
  gsub(/`/, "")  # Doxygen shows no code in a heading that has a name
  print $0 " {#" name_of(page) "-" anchor_of(title) "}"
  next
}
{
  line = $0
  out = ""
  while (match(line, /!?\[[^][]+\]\([^() ]+\)/)) {
    found = substr(line, RSTART, RLENGTH)
    before = substr(line, 1, RSTART - 1)
    line = substr(line, RSTART + RLENGTH)
    out = out linked(before)
    if (found ~ /^!/) { sub(/\]\(.*\//, "](", found); out = out found; continue }
    middle = index(found, "](")
    out = out reference(substr(found, 2, middle - 2), substr(found, middle + 2, length(found) - middle - 2))
  }
  print out linked(line)
}
