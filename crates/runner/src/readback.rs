//! Brings what the device holds back into memory.

use std::sync::mpsc;
use std::time::Duration;

use crate::device::Device;
use crate::error::Error;
use crate::limits::within;

/// How long the word that a buffer is mapped may come after the work is done: it is said by whichever thread polls the
/// device, which may be another one, in the middle of it. Only a thread that is stuck takes this long.
const PATIENCE: Duration = Duration::from_secs(30);

/// What the bytes of a row must be a multiple of, in copies from textures to buffers.
const ROW_ALIGNMENT: u32 = wgpu::COPY_BYTES_PER_ROW_ALIGNMENT;

/// A buffer that the device copies into and the CPU reads.
pub(crate) struct Staging {
    buffer: wgpu::Buffer,
}

impl Staging {
    pub(crate) fn new(device: &Device, label: &str, bytes: u64) -> Self {
        let buffer = device.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some(label),
            size: bytes,
            usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
            mapped_at_creation: false,
        });
        Self { buffer }
    }

    /// The buffer to copy into.
    pub(crate) fn buffer(&self) -> &wgpu::Buffer {
        &self.buffer
    }

    /// Waits for the submission that copies into the buffer, and reads the bytes.
    pub(crate) fn read(
        &self,
        device: &Device,
        job: &str,
        submission: wgpu::SubmissionIndex,
    ) -> Result<Vec<u8>, Error> {
        let failed = |message: String| Error::Internal {
            job: job.to_owned(),
            message,
        };
        let (sender, receiver) = mpsc::channel();
        // A failure to send would mean that nobody listens any more: nothing to tell then.
        self.buffer
            .map_async(wgpu::MapMode::Read, .., move |result| drop(sender.send(result)));
        device.wait(job, submission)?;
        let answer = receiver.recv_timeout(PATIENCE);
        let answer = answer.map_err(|error| failed(format!("reading back: no answer: {error}")))?;
        answer.map_err(|error| failed(format!("reading back: {error}")))?;
        let bytes = self
            .buffer
            .get_mapped_range(..)
            .map_err(|error| failed(format!("reading back: {error}")))?;
        let copied = bytes.to_vec();
        drop(bytes);
        self.buffer.unmap();
        Ok(copied)
    }
}

/// Copies several buffers back in one go, after what `encoder` holds.
pub(crate) fn buffers(
    device: &Device,
    job: &str,
    mut encoder: wgpu::CommandEncoder,
    sources: &[&wgpu::Buffer],
) -> Result<(Vec<Vec<u8>>, wgpu::SubmissionIndex), Error> {
    let total: u64 = sources.iter().map(|buffer| buffer.size()).sum();
    if total == 0 {
        let submission = device.queue.submit([encoder.finish()]);
        device.wait(job, submission.clone())?;
        return Ok((Vec::new(), submission));
    }
    within(
        job,
        "the size of all outputs in bytes",
        total,
        device.limits().max_buffer_size,
    )?;
    let staging = Staging::new(device, job, total);
    let mut offset = 0;
    for source in sources {
        encoder.copy_buffer_to_buffer(source, 0, staging.buffer(), offset, source.size());
        offset += source.size();
    }
    let submission = device.queue.submit([encoder.finish()]);
    let bytes = staging.read(device, job, submission.clone())?;
    let mut rest = bytes.as_slice();
    let mut taken = Vec::with_capacity(sources.len());
    for source in sources {
        let (own, after) = rest.split_at(source.size() as usize);
        taken.push(own.to_vec());
        rest = after;
    }
    Ok((taken, submission))
}

/// A texture's first level on its way back, layer by layer: rows are padded in the staging buffer.
pub(crate) struct PictureCopy {
    staging: Staging,
    row_bytes: u32,
    padded: u32,
}

impl PictureCopy {
    /// Encodes the copy of one aspect of a texture.
    pub(crate) fn encode(
        device: &Device,
        encoder: &mut wgpu::CommandEncoder,
        texture: &wgpu::Texture,
        aspect: wgpu::TextureAspect,
        texel_bytes: u32,
    ) -> Self {
        let row_bytes = texture.width() * texel_bytes;
        let padded = row_bytes.next_multiple_of(ROW_ALIGNMENT);
        let rows = texture.height() * texture.depth_or_array_layers();
        let staging = Staging::new(device, "picture", u64::from(padded) * u64::from(rows));
        let from = wgpu::TexelCopyTextureInfo {
            texture,
            mip_level: 0,
            origin: wgpu::Origin3d::ZERO,
            aspect,
        };
        let layout = wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(padded),
            rows_per_image: Some(texture.height()),
        };
        let to = wgpu::TexelCopyBufferInfo {
            buffer: staging.buffer(),
            layout,
        };
        encoder.copy_texture_to_buffer(from, to, texture.size());
        Self {
            staging,
            row_bytes,
            padded,
        }
    }

    /// The bytes, row by row without padding, once the copy was submitted.
    pub(crate) fn read(
        &self,
        device: &Device,
        job: &str,
        submission: wgpu::SubmissionIndex,
    ) -> Result<Vec<u8>, Error> {
        let bytes = self.staging.read(device, job, submission)?;
        let rows = bytes
            .chunks(self.padded as usize)
            .map(|row| &row[..self.row_bytes as usize]);
        Ok(rows.collect::<Vec<_>>().concat())
    }
}
