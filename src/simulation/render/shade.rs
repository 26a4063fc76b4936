//! From what is seen to colours.

use nalgebra::Isometry3;
use rayon::prelude::*;

use super::frame::Frame;
use super::light::{Light, reflected};
use super::occlusion::Shadows;
use super::raster::BAND;
use super::scene::Scene;
use super::texture::albedo;
use super::tone::encode;
use super::vector::V3;
use super::visible::{View, Visible, look};
use crate::geometry::Camera;

impl Scene {
    /// What a camera at `world_from_camera` (optical frame: z forward, x right, y down) sees.
    ///
    /// Depth and mask are exact: at each pixel what its ray meets first. Works on the threads of
    /// the rayon pool it is called in; the bytes do not depend on their number.
    pub fn render(&self, camera: &Camera, world_from_camera: &Isometry3<f64>) -> Frame {
        let view = View::new(camera, world_from_camera);
        let visible = look(self, camera, world_from_camera, &view);
        Frame {
            width: camera.width,
            height: camera.height,
            colour: self.shade(&view, &visible, camera.width as usize),
            depth_m: visible.iter().map(|it| it.depth_m).collect(),
            mask: visible.iter().map(|it| self.mask_of(it)).collect(),
        }
    }

    fn mask_of(&self, visible: &Visible) -> u16 {
        self.instances.get(visible.instance as usize).map_or(0, |instance| instance.mask)
    }

    fn shade(&self, view: &View, visible: &[Visible], width: usize) -> Vec<[u8; 3]> {
        let light = Light::of(&self.lighting);
        let shadows = Shadows::of(self, &light, view, visible, width);
        let background = encode(light.background);
        let mut colour = vec![background; visible.len()];
        let bands = colour.par_chunks_mut(width * BAND).enumerate();
        bands.for_each(|(band, colours)| {
            for (n, colour) in colours.iter_mut().enumerate() {
                let pixel = band * BAND * width + n;
                if visible[pixel].is_something() {
                    let (x, y) = (pixel % width, pixel / width);
                    let seen = &visible[pixel];
                    *colour = encode(self.light_from(&light, &shadows, view, seen, x, y));
                }
            }
        });
        colour
    }

    /// The light that comes from what is seen at a pixel.
    fn light_from(
        &self,
        light: &Light,
        shadows: &Shadows,
        view: &View,
        visible: &Visible,
        x: usize,
        y: usize,
    ) -> V3 {
        let point = view.point(self, x, y, visible);
        let footprint = view.footprint() * visible.depth_m;
        let albedo = albedo(point.material, point.in_thing, point.normal_in_thing, footprint);
        let openness = shadows.at(self, light, &point, x, y);
        reflected(albedo, light.on(point.at, point.normal, openness.open, openness.lit))
    }
}
