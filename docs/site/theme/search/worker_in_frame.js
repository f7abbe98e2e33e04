// SPDX-License-Identifier: BSD-3-Clause
// Where a page is opened as a file, browsers refuse to start a Worker. This one runs its script in a hidden frame instead, with the
// part of Worker's interface that the theme's search uses: postMessage() and messages back.
if (location.protocol === "file:") {
  window.Worker = class extends EventTarget {
    constructor(script) {
      super();
      const frame = document.createElement("iframe");
      frame.hidden = true;
      document.body.appendChild(frame);
      const inside = frame.contentWindow, page = frame.contentDocument;
      const load = (address) =>
        new Promise((done, failed) => {
          const element = page.createElement("script");
          element.src = new URL(address, location.href);
          element.onload = done;
          element.onerror = failed;
          page.body.appendChild(element);
        });
      const answer = (data) => {
        const message = new MessageEvent("message", { data });
        this.dispatchEvent(message);
        if (this.onmessage) this.onmessage(message);
      };
      inside.postMessage = (data) => setTimeout(answer, 0, data);
      inside.importScripts = (...addresses) => Promise.all(addresses.map(load));
      this.ready = load(script);
      this.send = (data) => inside.dispatchEvent(new inside.MessageEvent("message", { data }));
    }

    postMessage(data) {
      this.ready.then(() => this.send(data));
    }
  };
}
