// Starts the viewer in a report.

const viewerIndex = JSON.parse(byId("viewer-index").textContent);
byId("viewer").hidden = false;
byId("sampled").textContent = viewerIndex.note;
if (viewerIndex.runs.length) {
  new Viewer(viewerIndex).open(viewerIndex.first).catch((error) => {
    byId("status").textContent = `The recorded runs cannot be shown: ${error.message}. The tables below are complete.`;
  });
} else {
  document.querySelectorAll("#viewer > :not(h2, #sampled)").forEach((part) => part.remove());
}
