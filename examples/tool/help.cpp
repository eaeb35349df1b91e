// SPDX-License-Identifier: MIT
// The texts of --help.
#include "tool/commands.h"

namespace tool {

namespace {

struct Help {
  std::string_view command;
  const char* text;
};

constexpr Help texts[] = {
    {"",
     "usage: topoadapt COMMAND ...\n"
     "  segment (VOLUME | --phantom NAME)   inflates a ball in an image until it fills the object round the seed\n"
     "  detect MESH                         counts the pairs of triangles that meet\n"
     "  resolve MESH --out M                makes a tangled mesh the surface of its region\n"
     "  validate MESH                       counts components, genus, self-intersections\n"
     "  evolve (SCENE | --list)             plays a scene of moving bodies\n"
     "  handles SIDES SIDES [SIDES [SIDES]] counts the handles between polygons\n"
     "topoadapt COMMAND --help   options of a command, with units and defaults\n"
     "topoadapt --version\n"
     "exit code: 0 done, 1 the answer is no, 2 bad usage or input, with one line that says why\n"},
    {"segment",
     "usage: topoadapt segment (VOLUME --seed x,y,z --threshold T [--bright] | VOLUME --info | --phantom NAME) "
     "[option ...]\n"
     "Inflates a ball in an image until it fills the object round the seed: the voxels beyond the threshold that are\n"
     "connected with the seed across faces. Lengths and places count in mm of the file's world. Exit code 1 if the "
     "mesh\n"
     "fills less than 95 % of the object, leaks into neighbours, or has another genus than asked for.\n"
     "  --info            says what VOLUME holds, and segments nothing: size, world box, histogram, a threshold "
     "between two\n"
     "                    classes (Otsu 1979) or --threshold, a seed for dark and bright, labels; --png: three slices "
     "with\n"
     "                    the threshold's contour, through the middle or --seed\n"
     "  VOLUME            .nii .hdr .img .nrrd .nhdr .mha .mhd .mgh .mgz, also with .gz or .bz2; a folder of DICOM\n"
     "                    slices, or a file of one of the series in a folder\n"
     "  --time K          the K-th time point of several, from 0 (one only)\n"
     "  --phantom NAME    cube-cavity, genus-3, torus-nested, cyst; seed, radius, threshold and edge suit the phantom\n"
     "  --noise-seed N    whole number that the phantom's noise is made from (1)\n"
     "  --seed x,y,z      centre of a first ball, in voxels from 0; may be given several times\n"
     "  --seed-mm x,y,z   the same in mm, of --space ras or lps if given; VOLUME needs at least one seed\n"
     "  --radius R        of the first balls, in mm (4 voxels, or less where the object is thinner round the seeds)\n"
     "  --threshold T     grey value of the object's border; VOLUME needs it, or one of the next three\n"
     "  --bright          the object is brighter than T; else it is darker\n"
     "  --lower A         the object has grey values above A\n"
     "  --upper B         the object has grey values below B; with --lower: between both\n"
     "  --label K         the object has the value K, in a label map; without seeds, its own surface is the first\n"
     "  --all-labels      every label but 0 in turn; --out M writes all to one file, with labels in .ply .vtp .vtk "
     ".obj, "
     "or\n"
     "                    a file for each where M holds %d; --mask holds the labels\n"
     "  --start-mask F    begins with the surface of the nonzero voxels of another volume, in place of balls\n"
     "  --start-mesh F    begins with a closed mesh free of self-intersections, in the coordinates of --space\n"
     "  --nan-as-background  voxels that are NaN are not of the object; else they are refused\n"
     "  --sigma S         Gaussian filter applied first, in mm, at most 100 voxels along each axis (0, none)\n"
     "  --edge L          length of edges aimed at, in mm (1.7 voxels)\n"
     "  --edge-fine F     shortest edges aimed at where voxels are left out, in mm, from L / 255; L: one\n"
     "                    length (0.2 L)\n"
     "  --width W         grey values from T to full force (by contrast and noise at the object's border)\n"
     "  --tension G       part of the way to the mean of its neighbours that a vertex moves, 0 to 1 (0.25)\n"
     "  --speed K         edge lengths for each iteration at full force, above 0 (0.38)\n"
     "  --iterations N    ends after so many iterations (5000)\n"
     "  --threads N       threads, 1 to 256; the result is the same (1)\n"
     "  --partial         a mesh that does not fill the object is an answer, too\n"
     "  --drop-below V    leaves out components of less than V mm3 (0)\n"
     "  --genus G         the genus expected, over all components (any)\n"
     "  --space S         coordinates of the mesh: ras or lps, in mm, or voxel (the file's own: ras for NIfTI, lps "
     "for\n"
     "                    MetaImage, as declared for NRRD)\n"
     "  --out M           writes the mesh: .obj .off .ply .stl .vtp .vtk .gii\n"
     "  --mask F          writes the voxels inside the mesh as 1 in the input's grid: .nii .nii.gz .nrrd\n"
     "  --every N         iterations between two meshes written to the folder of --frames\n"
     "  --frames DIR      receives frame-000004.ply and so on\n"
     "  --save F          writes the state at the end, after Ctrl-C too, to go on from\n"
     "  --resume F        goes on from a saved state, with the same VOLUME and options as before; a state from after "
     "the\n"
     "                    first rest, where edges are short round voxels left out, does not give the bits of one run\n"
     "  --html V          writes a page to look at, offline in any browser: mesh, slices with its contour, the\n"
     "                    run on a time line\n"
     "  --png P           writes a picture: three slices with the contour, and the mesh\n"
     "  --json R          writes the report to a file, or to standard output for -; volumes in mm3, times in seconds\n"
     "  --max-vertices N  most vertices of the mesh, 4 to 2^29 (2^29)\n"
     "  --max-bytes N     most bytes of the library's memory (no bound)\n"
     "  --quiet           neither notes nor progress on standard error\n"},
    {"detect",
     "usage: topoadapt detect MESH [option ...]\n"
     "Counts the pairs of triangles that meet beyond a common corner or edge. Exit code 1 if there are any. The mesh "
     "may\n"
     "be open. A triangle without area counts as one pair, with itself, and no other, as in CGAL.\n"
     "Cleaned, with a note of how many: equal positions become one vertex; vertices without a triangle, triangles\n"
     "with a corner twice, and faces there twice go; facets that wind against all others round are turned; edges of\n"
     "four triangles are parted.\n"
     "  MESH              .obj .off .ply .stl .vtp .gii; polygons become triangles, coordinates below 2^-100 become 0\n"
     "  --mode MODE       complete, or vertex-hash, the paper's, which misses pairs (complete)\n"
     "  --cell L          length of a cell of vertex-hash, in the unit of the coordinates (1)\n"
     "  --pairs           lists the pairs on standard output, triangles numbered from 0\n"
     "  --weld LENGTH     vertices within LENGTH of an earlier one become one with it (only at equal positions)\n"
     "  --fill EDGES      closes holes of at most so many edges, 3 to 384, if nothing is met (none)\n"
     "  --as-is           refuses a mesh that would have to be cleaned\n"
     "  --turn            turns every triangle round first, for a mesh that is inside out\n"
     "  --turn-parts      turns the components that are inside out, and that no outward component contains\n"
     "  --json R          writes the report to a file, or to standard output for -; times in seconds\n"
     "  --max-vertices N  most vertices of the mesh, 4 to 2^29 (2^29)\n"
     "  --max-bytes N     most bytes of the library's memory (no bound)\n"
     "  --quiet           no notes on standard error\n"},
    {"resolve",
     "usage: topoadapt resolve MESH --out M [option ...]\n"
     "Makes a tangled mesh the surface of its region of winding number 1 or more. Exit code 1 if pairs are left, the\n"
     "mesh being as it was, if more than 1 % of the region would be lost or gained, or if a component is inside out "
     "and\n"
     "no outward component contains it; nothing is written then.\n"
     "Cleaned, with a note of how many: equal positions become one vertex; vertices without a triangle, triangles\n"
     "with a corner twice, and faces there twice go; facets that wind against all others round are turned; edges of\n"
     "four triangles are parted.\n"
     "  MESH              .obj .off .ply .stl .vtp .gii; polygons become triangles, coordinates below 2^-100 become "
     "0.\n"
     "                    A mesh that is inside out (negative signed volume in all) needs --turn\n"
     "  --out M           writes the mesh: .obj .off .ply .stl .vtp .vtk .gii\n"
     "  --weld LENGTH     vertices within LENGTH of an earlier one become one with it (only at equal positions)\n"
     "  --fill EDGES      closes holes of at most so many edges, 3 to 384, if nothing is met (none)\n"
     "  --as-is           refuses a mesh that would have to be cleaned\n"
     "  --turn            turns every triangle round first, for a mesh that is inside out\n"
     "  --turn-parts      turns the components that are inside out, and that no outward component contains\n"
     "  --html V          writes a page to look at, offline in any browser: before and after, with the triangles\n"
     "                    that meet\n"
     "  --png P           writes a picture: the mesh before and after\n"
     "  --json R          writes the report to a file, or to standard output for -; times in seconds\n"
     "  --max-vertices N  most vertices of the mesh, 4 to 2^29 (2^29)\n"
     "  --max-bytes N     most bytes of the library's memory (no bound)\n"
     "  --quiet           no notes on standard error\n"},
    {"validate",
     "usage: topoadapt validate MESH [option ...]\n"
     "Counts components, genus, self-intersections of a closed mesh. Exit code 1 if triangles meet.\n"
     "Cleaned, with a note of how many: equal positions become one vertex; vertices without a triangle, triangles\n"
     "with a corner twice, and faces there twice go; facets that wind against all others round are turned; edges of\n"
     "four triangles are parted.\n"
     "  MESH              .obj .off .ply .stl .vtp .gii; polygons become triangles, coordinates below 2^-100 become 0\n"
     "  --weld LENGTH     vertices within LENGTH of an earlier one become one with it (only at equal positions)\n"
     "  --fill EDGES      closes holes of at most so many edges, 3 to 384, if nothing is met (none)\n"
     "  --as-is           refuses a mesh that would have to be cleaned\n"
     "  --turn            turns every triangle round first, for a mesh that is inside out\n"
     "  --turn-parts      turns the components that are inside out, and that no outward component contains\n"
     "  --json R          writes the report to a file, or to standard output for -; volume and area in the unit of "
     "the\n"
     "                    coordinates, times in seconds\n"
     "  --max-vertices N  most vertices of the mesh, 4 to 2^29 (2^29)\n"
     "  --max-bytes N     most bytes of the library's memory (no bound)\n"
     "  --quiet           no notes on standard error\n"},
    {"evolve",
     "usage: topoadapt evolve (SCENE [option ...] | --list)\n"
     "Plays a scene of moving bodies. Exit code 1 if triangles meet at the end, or topology or volume are not the\n"
     "scene's.\n"
     "  --list            lists the scenes\n"
     "  --seed N          whole number that the scene is made from (1)\n"
     "  --renumber N      shuffles vertices and triangles, by a whole number (as made)\n"
     "  --turn R          turns the scene by one of the 24 rotations of the axes, 0 to 23 (as made)\n"
     "  --steps N         ends after so many steps (at the scene's end)\n"
     "  --stride K        longest way of a vertex in a step, in mean edge lengths; 0 is the scene's own step (0)\n"
     "  --no-substeps     leaves long steps uncut\n"
     "  --out M           writes the mesh: .obj .off .ply .stl .vtp .vtk .gii\n"
     "  --html V          writes a page to look at, offline in any browser: the run on a time line\n"
     "  --png P           writes a picture: six moments of the run\n"
     "  --json R          writes the report to a file, or to standard output for -; times in seconds\n"
     "  --max-vertices N  most vertices of the mesh, 4 to 2^29 (2^29)\n"
     "  --max-bytes N     most bytes of the library's memory (no bound)\n"
     "  --quiet           neither notes nor progress on standard error\n"},
    {"handles",
     "usage: topoadapt handles SIDES SIDES [SIDES [SIDES]] [option ...]\n"
     "Counts the database's handles between two to four polygons of 3 to 15 sides each.\n"
     "  --list            a handle for each line on standard output, vertices numbered from 1\n"
     "  --json R          writes the report to a file, or to standard output for -\n"
     "  --quiet           no notes on standard error\n"},
};

}  // namespace

const char* help_of(std::string_view command) {
  for (const Help& help : texts)
    if (help.command == command) return help.text;
  return nullptr;
}

}  // namespace tool
