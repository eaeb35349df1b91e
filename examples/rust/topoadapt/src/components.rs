// SPDX-License-Identifier: MIT
use alloc::vec::Vec;
use core::slice;
use topoadapt_sys::tpa_component;

/// A connected component of the present mesh.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Component {
    /// The smallest vertex id.
    pub id: u32,
    /// The smallest related component before the last commit, in ids of that time.
    pub before: u32,
    /// Number of vertices.
    pub vertices: u32,
    /// Number of triangles.
    pub triangles: u32,
    /// Genus.
    pub genus: i32,
    /// Enclosed volume; negative where triangles wind inward, as round a void.
    pub volume: f64,
    /// Area.
    pub area: f64,
    /// Least x y z of the vertices.
    pub least: [f64; 3],
    /// Greatest x y z of the vertices.
    pub greatest: [f64; 3],
}

impl Component {
    pub(crate) fn of(raw: &tpa_component) -> Component {
        let [x0, y0, z0, x1, y1, z1] = raw.box_;
        Component {
            id: raw.id,
            before: raw.before,
            vertices: raw.vertices,
            triangles: raw.triangles,
            genus: raw.genus,
            volume: raw.volume,
            area: raw.area,
            least: [x0, y0, z0],
            greatest: [x1, y1, z1],
        }
    }
}

/// All components, ascending by id, and the component of each vertex.
#[derive(Clone, Debug)]
pub struct Components {
    pub(crate) list: Vec<Component>,
    pub(crate) labels: Vec<u32>,
}

impl Components {
    /// Number of components.
    pub fn len(&self) -> usize {
        self.list.len()
    }

    /// True for an empty mesh.
    pub fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// Iterates by ascending id.
    pub fn iter(&self) -> slice::Iter<'_, Component> {
        self.list.iter()
    }

    /// All components.
    pub fn as_slice(&self) -> &[Component] {
        &self.list
    }

    /// For each vertex the place of its component in [`Components::as_slice`].
    pub fn labels(&self) -> &[u32] {
        &self.labels
    }

    /// The component of a vertex; None for an unknown vertex.
    pub fn of_vertex(&self, vertex: u32) -> Option<&Component> {
        let label = *self.labels.get(vertex as usize)?;
        self.list.get(label as usize)
    }
}

impl<'a> IntoIterator for &'a Components {
    type Item = &'a Component;
    type IntoIter = slice::Iter<'a, Component>;
    fn into_iter(self) -> slice::Iter<'a, Component> {
        self.iter()
    }
}
