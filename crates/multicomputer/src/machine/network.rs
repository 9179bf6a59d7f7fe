//! The network of a machine file: model, message layer, links and routers.

use config::{Fault, Place};
use desim::Duration;

use super::file::{LinksFile, LogGpFile, NetworkFile};
use crate::network::{
    LinkParameters, LogGpParameters, NetworkModel, NetworkParameters, RouterStages,
};
use crate::sourced::Sourced;

/// Longest flit, bytes. With longer ones a link's bandwidth could not be distinguished from a message's.
const LONGEST_FLIT: f64 = 1e9;
/// Largest number of virtual channels per link; real routers have a few.
const MOST_VIRTUAL_CHANNELS: u8 = 16;

/// The chosen model of the network, with all that it needs.
pub(crate) fn network(
    file: &NetworkFile,
    hop_time: Duration,
) -> Result<(Option<NetworkModel>, NetworkParameters), Fault> {
    let software = file.parameters.as_ref().map(|parameters| loggp(parameters, hop_time));
    let links = match (&file.links, &software) {
        (Some(file), Some(software)) => Some(links(file, software)?),
        (Some(_), None) => return refuse("network", "\"parameters\" is missing; expected it"),
        (None, _) => None,
    };
    let model = file.model.model();
    if model != Some(NetworkModel::Ideal) && software.is_none() {
        return refuse("network", "\"parameters\" is missing; expected it");
    }
    if model.is_none_or(|model| model >= NetworkModel::Wormhole) && links.is_none() {
        return refuse("network", "\"links\" is missing; expected it");
    }
    Ok((model, NetworkParameters { software, links }))
}

fn links(file: &LinksFile, software: &LogGpParameters) -> Result<LinkParameters, Fault> {
    let (bandwidth, flit) = (file.bandwidth.si(), file.flit.si());
    if bandwidth < software.bandwidth {
        let (found, least) = (bandwidth / 1e6, software.bandwidth / 1e6);
        let message =
            format!("found {found} MB/s; expected at least {least} MB/s, the bandwidth of");
        return refuse("network.links.bandwidth.value", message + " the message layer");
    }
    if !(1.0..=LONGEST_FLIT).contains(&flit) || flit.fract() != 0.0 {
        let message = format!("found {flit} B; expected a whole number of bytes, at least 1");
        return refuse("network.links.flit.value", message);
    }
    let virtual_channels = file.virtual_channels.value.get();
    if virtual_channels > MOST_VIRTUAL_CHANNELS {
        let message = format!("found {virtual_channels}; expected 1 to {MOST_VIRTUAL_CHANNELS}");
        return refuse("network.links.virtual_channels.value", message);
    }
    let links = LinkParameters {
        bandwidth,
        flit_bytes: flit as u64,
        buffer_flits: file.buffer_flits.value.get().into(),
        virtual_channels: virtual_channels.into(),
        stages: stages(file),
    };
    let (hop, of_head) = (links.cycles(software.hop_time), links.stages.of_head());
    if of_head >= hop {
        let found = format!("found {of_head} cycles of routing and allocation");
        let message = format!("{found}; expected fewer than the {hop} of a hop");
        return refuse("network.links", message);
    }
    let least = links.flight(software.hop_time) + links.stages.credit;
    if u64::from(links.buffer_flits) < least {
        let found = format!("found {}; expected at least {least}", links.buffer_flits);
        let message = found + ", as many as leave until the first one's room can be used again";
        return refuse("network.links.buffer_flits.value", message);
    }
    Ok(links)
}

/// The stages of a router, each as the file states it or by default.
fn stages(file: &LinksFile) -> RouterStages {
    let default = RouterStages::default();
    let or =
        |cycles: &Option<Sourced<u8>>, default| cycles.as_ref().map_or(default, |c| c.value.into());
    RouterStages {
        routing: or(&file.routing_cycles, default.routing),
        allocation: or(&file.allocation_cycles, default.allocation),
        credit: file.credit_cycles.as_ref().map_or(default.credit, |c| c.value.get().into()),
    }
}

fn refuse<T>(place: &str, message: impl Into<String>) -> Result<T, Fault> {
    Err(Fault::at(Place::of(place), message))
}

fn loggp(file: &LogGpFile, hop_time: Duration) -> LogGpParameters {
    LogGpParameters {
        send_overhead: file.send_overhead.duration(),
        latency: file.latency.duration(),
        hop_time,
        receive_overhead: file.receive_overhead.duration(),
        gap: file.gap.duration(),
        bandwidth: file.bandwidth.si(),
    }
}
