#!/usr/bin/env bash
# usage: tools/fetch_openfoam_headers.sh CACHE
# Debian ships OpenFOAM's programs and libraries without headers.  This takes the matching headers from Debian's own source
# package, through apt and the machine's own package sources, and lays them out as CACHE/include/openfoam/<library>/, one flat
# folder a library (several libraries have headers of the same name).  Does nothing where they are there already.
set -euo pipefail
mkdir -p "$1"
cache=$(cd "$1" && pwd)
version=$(dpkg-query -W -f '${Version}' libopenfoam)
version=${version%+b*}
upstream=${version%-*}
headers=$cache/include/openfoam
[[ -f $headers/.complete-with-turbulence-$version ]] && exit 0
echo "OpenFOAM headers: fetching the source package of openfoam $version"

# A private apt configuration that asks the same servers for source packages; the machine's own lists stay as they are.
apt_root=$cache/apt
mkdir -p "$apt_root"/{parts,lists/partial,cache/archives/partial,source}
for sources in /etc/apt/sources.list.d/*.sources; do
  [[ -f $sources ]] && sed 's/^Types:.*/Types: deb-src/' "$sources" >"$apt_root/parts/$(basename "$sources")"
done
[[ -f /etc/apt/sources.list ]] && sed -n 's/^deb /deb-src /p' /etc/apt/sources.list >"$apt_root/parts/system.list"
private_apt() {
  apt-get -q -o Dir::Etc::SourceList=/dev/null -o "Dir::Etc::SourceParts=$apt_root/parts" \
    -o "Dir::State::Lists=$apt_root/lists" -o "Dir::Cache=$apt_root/cache" "$@"
}
archive=$apt_root/source/openfoam_$upstream.orig.tar.bz2
if [[ ! -f $archive ]]; then
  private_apt update || true # a server without source packages must not stop the others
  (cd "$apt_root/source" && private_apt source --download-only "openfoam=$version")
fi

tree=$cache/tree
rm -rf "$tree" "$headers" "$headers.partial"
mkdir -p "$tree" "$headers.partial"
tar xjf "$archive" -C "$tree" --strip-components=1 --wildcards '*/src/*.[HCh]'
declare -A folder=(
  [OpenFOAM]=OpenFOAM [OSspecific]=OSspecific/POSIX [Pstream]=Pstream/mpi [fileFormats]=fileFormats [surfMesh]=surfMesh
  [meshTools]=meshTools [specie]=thermophysicalModels/specie [finiteVolume]=finiteVolume [blockMesh]=mesh/blockMesh
  [turbulenceModels]=TurbulenceModels/turbulenceModels [compressibleTurbulenceModels]=TurbulenceModels/compressible
)
for library in "${!folder[@]}"; do
  mkdir -p "$headers.partial/$library"
  find "$tree/src/${folder[$library]}" -type f -name '*.[HCh]' -exec cp {} "$headers.partial/$library/" \;
done
# C++20 refuses template arguments in the names of constructors and destructors; three headers have them.
for name in DiagonalMatrix fvPatchField fvsPatchField; do
  find "$headers.partial" -name "$name.H" -exec sed -i -E "s/(^| |~|explicit )($name)<Type>\(/\1\2(/" {} +
done
rm -rf "$tree"
touch "$headers.partial/.complete-with-turbulence-$version"
mv "$headers.partial" "$headers"
