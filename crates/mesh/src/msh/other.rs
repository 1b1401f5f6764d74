//! Files of other programs given instead of a mesh, recognised by their first bytes.

use std::path::Path;

/// A file format that is not Gmsh's.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum OtherFormat {
    /// ISO 10303-21: solids of a CAD program.
    Step,
    /// IGES: surfaces of a CAD program.
    Iges,
    /// Solids of Open CASCADE.
    Brep,
    /// Triangles of a surface, text.
    Stl,
    /// Nodes and elements of Abaqus and CalculiX.
    Abaqus,
    /// Bulk data of Nastran.
    Nastran,
    /// Legacy files of VTK.
    Vtk,
}

/// Column of IGES records that says to which section a line belongs, from 0, and the length of a record.
const SECTION_OF_IGES: usize = 72;
const RECORD_OF_IGES: usize = 80;

impl OtherFormat {
    /// The format of a file, recognised by its first bytes. `None` if it may be a Gmsh mesh or is unknown.
    pub fn of(bytes: &[u8]) -> Option<Self> {
        let first = bytes.split(|b| *b == b'\n').next().unwrap_or_default();
        let first = first.strip_suffix(b"\r").unwrap_or(first);
        if first.len() == RECORD_OF_IGES && first[SECTION_OF_IGES] == b'S' && first[73..].ends_with(b"1") {
            return Some(Self::Iges);
        }
        let text = first.trim_ascii_start();
        let begins = |with: &str| text.get(..with.len()).is_some_and(|own| own.eq_ignore_ascii_case(with.as_bytes()));
        let known = [
            (Self::Step, &["ISO-10303-21"][..]),
            (Self::Brep, &["DBRep_DrawableShape", "CASCADE Topology"]),
            (Self::Stl, &["solid"]),
            (Self::Abaqus, &["**", "*heading", "*node", "*part", "*include"]),
            (Self::Nastran, &["$ nastran", "SOL ", "CEND", "BEGIN BULK", "NASTRAN"]),
            (Self::Vtk, &["# vtk DataFile"]),
        ];
        known.iter().find(|(_, all)| all.iter().any(|with| begins(with))).map(|(kind, _)| *kind)
    }

    /// Name of the format for messages.
    pub fn name(self) -> &'static str {
        match self {
            Self::Step => "a CAD file (STEP)",
            Self::Iges => "a CAD file (IGES)",
            Self::Brep => "a CAD file (BREP)",
            Self::Stl => "a surface of triangles (STL)",
            Self::Abaqus => "an input file of Abaqus or CalculiX",
            Self::Nastran => "bulk data of Nastran",
            Self::Vtk => "a file of VTK",
        }
    }

    /// How a mesh comes of it, and what the mesh needs.
    pub(crate) fn way_to_a_mesh(self, path: &Path) -> String {
        let (file, mesh) = (path.display(), path.with_extension("msh"));
        let mesh = mesh.display();
        let needs = "in mm, the axis on z and mid-face at z = 0; bore and flanks are found by their shape where no group is named";
        match self {
            Self::Step | Self::Iges | Self::Brep => format!(
                "mesh it with Gmsh: `gmsh -3 -order 2 -clmax SIZE {file} -o {mesh}` (SIZE in mm: a quarter of the module on \
                 flanks), {needs}"
            ),
            Self::Stl => format!(
                "a surface has no exact flanks and no inside: export the solid as STEP, and mesh it with Gmsh \
                 (`gmsh -3 -order 2 -clmax SIZE PART.step -o {mesh}`), {needs}"
            ),
            Self::Abaqus | Self::Nastran | Self::Vtk => {
                format!("convert it, as by `meshio convert {file} {mesh} --output-format gmsh22`, {needs}")
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Mesh, MeshError};

    /// Files of other programs are named, with a way from them to a mesh; a damaged mesh stays one.
    #[test]
    fn files_of_other_programs_are_named() {
        let iges = format!("{:<72}S      1\n1H,,1H;\n", "part");
        let cases: [(&str, OtherFormat, &str); 7] = [
            ("ISO-10303-21;\nHEADER;\n", OtherFormat::Step, "gmsh -3 -order 2 -clmax SIZE part.x -o part.msh"),
            (&iges, OtherFormat::Iges, "gmsh -3"),
            ("DBRep_DrawableShape\n", OtherFormat::Brep, "gmsh -3"),
            ("solid part\n facet normal 0 0 1\n", OtherFormat::Stl, "STEP"),
            ("*HEADING\n*NODE\n", OtherFormat::Abaqus, "meshio convert part.x part.msh"),
            ("SOL 101\nCEND\n", OtherFormat::Nastran, "meshio"),
            ("# vtk DataFile Version 3.0\n", OtherFormat::Vtk, "meshio"),
        ];
        for (text, kind, way) in cases {
            assert_eq!(OtherFormat::of(text.as_bytes()), Some(kind), "{text}");
            let error = Mesh::parse(text.as_bytes(), "part.x").expect_err(text);
            let hint = error.hint().unwrap_or_default();
            assert!(error.to_string().contains(kind.name()), "{error}");
            assert!(hint.contains(way) && hint.contains("in mm, the axis on z"), "{hint}");
        }
        for text in ["", "$MeshFormat\n", "$Nodes\n", "garbage", "\u{0}\u{1}"] {
            assert_eq!(OtherFormat::of(text.as_bytes()), None, "{text}");
            assert!(matches!(Mesh::parse(text.as_bytes(), "part.x"), Err(MeshError::Msh(_))), "{text}");
        }
    }
}
