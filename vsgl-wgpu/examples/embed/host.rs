//! The host's renderer.

use super::room;
use super::seen::{CORNER, Seen, corners, filled, pipeline, projection, texture};
use std::error::Error;
use vsgl_core::data::SceneData;
use vsgl_core::math::vec::orthonormal_basis;
use vsgl_core::plan::Plan;
use vsgl_core::scene::Light;
use vsgl_wgpu::interop::{Bounce, Colors, Export, HostGBuffer, HostMap};
use vsgl_wgpu::{Context, WgpuRes, wgpu};
use wgpu::TextureFormat as Format;

type Result<T> = std::result::Result<T, Box<dyn Error>>;

const INDIRECT: Format = Format::Rgba32Float;
const PICTURE: Format = Format::Rgba8UnormSrgb;

pub(crate) struct Host {
    pub(crate) device: wgpu::Device,
    pub(crate) queue: wgpu::Queue,
    pub(crate) width: u32,
    pub(crate) height: u32,
    camera: Seen,
    lamp: Seen,
    corners: wgpu::Buffer,
    count: u32,
    compose: wgpu::RenderPipeline,
    compose_group: wgpu::BindGroup,
    indirect: wgpu::TextureView,
    picture: wgpu::TextureView,
}

impl Host {
    /// A device of its own on the first adapter whose name holds `wanted`, and a picture of this size; the lamp's map has
    /// `map` texels along a side.
    pub(crate) fn new(wanted: &str, width: u32, height: u32, map: u32) -> Result<Self> {
        let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
        let all = pollster::block_on(instance.enumerate_adapters(wgpu::Backends::PRIMARY));
        let mut all = all.into_iter();
        let adapter = all.find(|adapter| adapter.get_info().name.contains(wanted));
        let adapter = adapter.ok_or("no adapter")?;
        let (device, queue) =
            pollster::block_on(adapter.request_device(&wgpu::DeviceDescriptor::default()))?;
        let module = device.create_shader_module(wgpu::include_wgsl!("host.wgsl"));
        let bytes = corners();
        let corners = filled(&device, &queue, wgpu::BufferUsages::VERTEX, &bytes);

        // The camera has reversed depth without an end, the lamp the usual one: vsgl takes both.
        let eye = room::camera();
        let near = 0.05;
        let lens = (eye.tan_half_fov, width as f32 / height as f32);
        let camera = projection(eye.eye, eye.forward, eye.up, lens, (0.0, near));
        let Light::Spot(spot) = room::lamp() else {
            return Err("a lamp of another kind".into());
        };
        let (near, far) = (0.1, 10.0);
        let share = far / (far - near);
        let (_, up) = orthonormal_basis(spot.axis);
        let lens = (spot.outer.tan(), 1.0);
        let to_lamp = projection(spot.position, spot.axis, up, lens, (share, -near * share));

        let camera = Seen::new(&device, &queue, &module, (width, height), camera, true);
        let lamp = Seen::new(&device, &queue, &module, (map, map), to_lamp, false);
        let storage = wgpu::TextureUsages::STORAGE_BINDING;
        let indirect = texture(&device, (width, height), INDIRECT, storage);
        let drawn = wgpu::TextureUsages::RENDER_ATTACHMENT;
        let picture = texture(&device, (width, height), PICTURE, drawn);

        let mut uniforms = camera.to_world.to_cols_array().to_vec();
        uniforms.extend(to_lamp.to_cols_array());
        uniforms.extend(spot.position.extend(spot.inner.cos()).to_array());
        uniforms.extend(spot.axis.extend(spot.outer.cos()).to_array());
        let [r, g, b] = spot.intensity;
        uniforms.extend([r, g, b, 1.5]);
        let bytes = bytemuck::cast_slice(&uniforms);
        let uniforms = filled(&device, &queue, wgpu::BufferUsages::UNIFORM, bytes);
        let compose = pipeline(
            &device,
            &module,
            ["compose_corner", "compose"],
            &[],
            &[PICTURE],
            None,
        );
        let views = [
            &camera.depth,
            &camera.normal,
            &camera.base,
            &camera.material,
            &lamp.depth,
            &indirect,
        ];
        let mut entries = vec![wgpu::BindGroupEntry {
            binding: 1,
            resource: uniforms.as_entire_binding(),
        }];
        entries.extend(views.iter().zip(2..).map(|(view, binding)| {
            let resource = wgpu::BindingResource::TextureView(view);
            wgpu::BindGroupEntry { binding, resource }
        }));
        let compose_group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: None,
            layout: &compose.get_bind_group_layout(0),
            entries: &entries,
        });
        Ok(Self {
            device,
            queue,
            width,
            height,
            camera,
            lamp,
            count: (corners.size() / CORNER) as u32,
            corners,
            compose,
            compose_group,
            indirect,
            picture,
        })
    }

    /// Draws one frame: everything into one encoder, which the host submits.
    pub(crate) fn frame(
        &self,
        vsgl: &Context,
        scene: Option<&WgpuRes<SceneData>>,
        plan: &Plan,
    ) -> Result<()> {
        let mut encoder = self.device.create_command_encoder(&Default::default());
        self.record(&mut encoder, vsgl, scene, plan)?;
        self.queue.submit([encoder.finish()]);
        Ok(())
    }

    /// Records one frame.
    pub(crate) fn record(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        vsgl: &Context,
        scene: Option<&WgpuRes<SceneData>>,
        plan: &Plan,
    ) -> Result<()> {
        self.draw(encoder, &self.camera);
        self.draw(encoder, &self.lamp);
        let gbuffer = vsgl.import_gbuffer(encoder, &self.gbuffer(), scene, plan)?;
        let lamp = room::lamp();
        let rsm = vsgl.import_rsm(encoder, &[self.map(&lamp)], scene, plan)?;
        let bounce = Bounce {
            gbuffer: &gbuffer,
            rsm: &rsm,
            scene,
            eye: room::camera().eye,
        };
        let radiance = vsgl.indirect(encoder, &bounce, plan)?;
        vsgl.export(encoder, &radiance, &self.indirect, Export::Store)?;
        self.compose(encoder);
        Ok(())
    }

    /// What the camera sees, for vsgl.
    pub(crate) fn gbuffer(&self) -> HostGBuffer<'_> {
        HostGBuffer {
            place: self.camera.place(),
            normals: self.camera.normals(),
            base_color: &self.camera.base,
            materials: self.camera.materials(),
            inverse_view_projection: self.camera.to_world,
            eye: room::camera().eye,
            dielectric_f0: 0.04,
        }
    }

    /// What the lamp sees, for vsgl.
    pub(crate) fn map<'a>(&'a self, light: &'a Light) -> HostMap<'a> {
        HostMap {
            light,
            place: self.lamp.place(),
            normals: self.lamp.normals(),
            colors: Colors::Base(&self.lamp.base),
            materials: self.lamp.materials(),
            inverse_view_projection: self.lamp.to_world,
            dielectric_f0: 0.04,
        }
    }

    fn draw(&self, encoder: &mut wgpu::CommandEncoder, seen: &Seen) {
        let color = |view| {
            Some(wgpu::RenderPassColorAttachment {
                view,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT),
                    store: wgpu::StoreOp::Store,
                },
            })
        };
        let depth = wgpu::RenderPassDepthStencilAttachment {
            view: &seen.depth,
            depth_ops: Some(wgpu::Operations {
                load: wgpu::LoadOp::Clear(seen.background),
                store: wgpu::StoreOp::Store,
            }),
            stencil_ops: None,
        };
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            color_attachments: &[
                color(&seen.normal),
                color(&seen.base),
                color(&seen.material),
            ],
            depth_stencil_attachment: Some(depth),
            ..Default::default()
        });
        pass.set_pipeline(&seen.pipeline);
        pass.set_bind_group(0, &seen.group, &[]);
        pass.set_vertex_buffer(0, self.corners.slice(..));
        pass.draw(0..self.count, 0..1);
    }

    fn compose(&self, encoder: &mut wgpu::CommandEncoder) {
        let color = wgpu::RenderPassColorAttachment {
            view: &self.picture,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations::default(),
        };
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            color_attachments: &[Some(color)],
            ..Default::default()
        });
        pass.set_pipeline(&self.compose);
        pass.set_bind_group(0, &self.compose_group, &[]);
        pass.draw(0..3, 0..1);
    }

    /// The finished picture, four bytes a pixel.
    pub(crate) fn picture(&self) -> Result<Vec<u8>> {
        self.read(&self.picture, 4)
    }

    /// The light of one bounce \[W/(m² sr)\], four numbers a pixel.
    #[allow(dead_code, reason = "for those who look closer than at the picture")]
    pub(crate) fn indirect(&self) -> Result<Vec<[f32; 4]>> {
        Ok(bytemuck::pod_collect_to_vec(
            &self.read(&self.indirect, 16)?,
        ))
    }

    pub(crate) fn read(&self, view: &wgpu::TextureView, bytes: u32) -> Result<Vec<u8>> {
        let row = (self.width * bytes).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let buffer = self.device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: u64::from(row * self.height),
            usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let mut encoder = self.device.create_command_encoder(&Default::default());
        let layout = wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(row),
            rows_per_image: None,
        };
        encoder.copy_texture_to_buffer(
            view.texture().as_image_copy(),
            wgpu::TexelCopyBufferInfo {
                buffer: &buffer,
                layout,
            },
            view.texture().size(),
        );
        self.queue.submit([encoder.finish()]);
        buffer.map_async(wgpu::MapMode::Read, .., |_| {});
        self.device.poll(wgpu::PollType::wait_indefinitely())?;
        let mapped = buffer.get_mapped_range(..)?;
        let rows = mapped.chunks(row as usize);
        let used = (self.width * bytes) as usize;
        Ok(rows.flat_map(|row| row[..used].to_vec()).collect())
    }
}
