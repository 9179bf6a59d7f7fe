//! Whether a request is addressed to this host.

use std::net::IpAddr;

/// Whether a request's `Host` names a server that listens at this address.
///
/// A foreign page whose name was made to point here (DNS rebinding) still sends its own name. The port is
/// not checked: behind a tunnel it is a different one.
pub(crate) fn is_ours(host: &str, address: IpAddr) -> bool {
    let name = match host.strip_prefix('[') {
        Some(rest) => rest.split(']').next().unwrap_or_default(),
        None => host.split(':').next().unwrap_or_default(),
    };
    let number: Option<IpAddr> = name.parse().ok();
    match number {
        Some(number) => number.is_loopback() || !address.is_loopback(),
        None => name.eq_ignore_ascii_case("localhost"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn foreign_names_are_refused() {
        let loopback = IpAddr::from([127, 0, 0, 1]);
        for host in ["127.0.0.1:80", "localhost", "LOCALHOST:9", "[::1]:80", "127.0.0.1"] {
            assert!(is_ours(host, loopback), "{host}");
        }
        let foreign = [
            "",
            "evil.example",
            "evil.example:80",
            "localhost.evil.example",
            "192.168.0.1",
            "[::2]",
            "[",
        ];
        for host in foreign {
            assert!(!is_ours(host, loopback), "{host}");
        }
        let all = IpAddr::from([0, 0, 0, 0]);
        assert!(is_ours("192.168.0.1:80", all) && is_ours("localhost", all));
        assert!(!is_ours("evil.example", all));
    }
}
