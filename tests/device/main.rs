//! What needs a device: one program, so that all its tests share one, opened once.

mod accuracy;
mod adjacency;
mod clashes;
mod common;
mod contract;
mod counters;
mod counting;
mod facing;
mod faults;
mod gbuffer;
mod limits;
mod maps;
mod metamorphic;
mod methods;
mod minimise;
mod moving_light;
mod occlusion;
mod plan;
mod rays;
mod regression;
mod silhouette_cpu;
mod silhouette_cs;
mod silhouette_ms;
mod stability;
mod study;
