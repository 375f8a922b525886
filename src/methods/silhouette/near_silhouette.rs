//! The edges that a light may put on the silhouette, chosen on the processor group by group.

use crate::frame::Frame;
use crate::geometry::open_edges::is_irregular;
use crate::geometry::silhouette::PlaneTree;
use crate::geometry::{EdgeTriangles, Topology};
use crate::gpu::{DeviceError, Gpu};
use crate::methods::edge_records::EdgeRecords;
use crate::methods::faces::{ChooseDraws, SELECT_STAGE};
use crate::scene::Mesh;
use glam::Vec4;
use std::ops::Range;

/// The primitives of edge records, as elements.
pub(super) enum EdgeElements {
    /// The number of the record.
    Number,
    /// So many of the list for each record.
    Patches(u32, Vec<u32>),
}

/// Chooses edges for a light.
pub(super) struct NearSilhouette {
    tree: PlaneTree,
    /// Edges that the tree may leave out though triangles that face the light have them on their silhouette.
    irregular: Vec<u32>,
    elements: EdgeElements,
    /// The records of each edge.
    records: Vec<Range<u32>>,
    /// The edges of each object that casts, in drawing order.
    objects: Vec<Range<u32>>,
    /// A bit for each edge, so that chosen edges come in the order of the mesh: neighbours share vertices.
    marked: Vec<u64>,
    /// Of the frame under way.
    chosen: Vec<u32>,
    draws: Vec<Range<u32>>,
    buffer: wgpu::Buffer,
}

impl NearSilhouette {
    /// For these records of the edges of a topology; with its `triangles` where not all of them cast.
    ///
    /// # Errors
    /// When the device has no room for the elements of all of them.
    pub(super) fn new(
        gpu: &Gpu,
        (mesh, topology, triangles): (&Mesh, &Topology, Option<&EdgeTriangles>),
        records: &EdgeRecords,
        elements: EdgeElements,
    ) -> Result<Self, DeviceError> {
        let per_record = match elements {
            EdgeElements::Number => 1,
            EdgeElements::Patches(per_record, _) => u64::from(per_record),
        };
        let bytes = (records.edges.len() as u64 * per_record * size_of::<u32>() as u64).max(4);
        let usage = wgpu::BufferUsages::INDEX | wgpu::BufferUsages::COPY_DST;
        let objects = mesh.objects.iter().zip(&topology.object_edges);
        let casters = objects.filter(|(object, _)| object.casts_shadow);
        let objects: Vec<_> = casters.map(|(_, edges)| edges.clone()).collect();
        let irregular = triangles.map_or(Vec::new(), |triangles| {
            let edges = (0..).zip(&topology.edges);
            let irregular = edges.filter(|(_, edge)| is_irregular(triangles.of(**edge)));
            irregular.map(|(number, _)| number).collect()
        });
        Ok(Self {
            irregular,
            tree: PlaneTree::build(mesh, topology),
            elements,
            records: records.of_edges(topology, &objects),
            objects,
            marked: vec![0; topology.edges.len().div_ceil(64)],
            chosen: Vec::new(),
            draws: Vec::new(),
            buffer: gpu.empty_buffer("the edges near the silhouette", bytes, usage)?,
        })
    }

    /// The buffer that what is chosen comes to.
    pub(super) fn buffer(&self) -> &wgpu::Buffer {
        &self.buffer
    }

    fn choose_for(&mut self, light: Vec4) {
        let Self {
            tree,
            irregular,
            marked,
            ..
        } = self;
        let mut mark = |edge: u32| marked[edge as usize / 64] |= 1 << (edge % 64);
        tree.for_each_asked(light, &mut mark);
        irregular.iter().copied().for_each(mark);
        self.chosen.clear();
        self.draws.clear();
        for object in 0..self.objects.len() {
            let start = self.chosen.len() as u32;
            let edges = self.objects[object].clone();
            if !edges.is_empty() {
                self.take_marked(edges);
            }
            self.draws.push(start..self.chosen.len() as u32);
        }
        self.marked.fill(0);
    }

    fn take_marked(&mut self, edges: Range<u32>) {
        let Self {
            elements,
            records,
            marked,
            chosen,
            ..
        } = self;
        let (first, last) = (edges.start, edges.end - 1);
        for word in first / 64..=last / 64 {
            let mut bits = marked[word as usize];
            if word == first / 64 {
                bits &= u64::MAX << (first % 64);
            }
            if word == last / 64 {
                bits &= u64::MAX >> (63 - last % 64);
            }
            while bits != 0 {
                let edge = 64 * word + bits.trailing_zeros();
                bits &= bits - 1;
                let records = records[edge as usize].clone();
                match elements {
                    EdgeElements::Number => chosen.extend(records),
                    EdgeElements::Patches(per_record, all) => {
                        let [start, end] =
                            [records.start, records.end].map(|at| (at * *per_record) as usize);
                        chosen.extend_from_slice(&all[start..end]);
                    }
                }
            }
        }
    }
}

impl ChooseDraws for NearSilhouette {
    fn choose(&mut self, frame: &mut Frame<'_>) -> anyhow::Result<()> {
        let light = frame.view().light.place;
        frame.stage(SELECT_STAGE, |stage| {
            stage.on_processor(|| self.choose_for(light));
            stage.upload(&self.buffer, 0, bytemuck::cast_slice(&self.chosen))
        })
    }

    fn chosen(&self) -> &[Range<u32>] {
        &self.draws
    }
}
