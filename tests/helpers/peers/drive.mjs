// Drives a served robot with npm's roslib, and prints what came of it as JSON.
// Usage: node drive.mjs ws://127.0.0.1:PORT < goals.json
import { readFileSync } from "node:fs";
import { Action, Ros, Service, Topic } from "roslib";

const goals = JSON.parse(readFileSync(0, "utf8"));
const ros = new Ros({ url: process.argv[2] });
await new Promise((resolve, reject) => {
  ros.on("connection", resolve);
  ros.on("error", reject);
});

const drive = new Action({
  ros,
  name: "/navigate_to_pose",
  actionType: "nav2_msgs/action/NavigateToPose",
});

function pursue(goal, cancelAtFirst) {
  return new Promise((resolve) => {
    let heard = 0;
    const id = drive.sendGoal(
      goal,
      (values) => resolve({ values, heard }),
      () => {
        heard += 1;
        if (cancelAtFirst && heard === 1) drive.cancelGoal(id);
      },
      (why) => resolve({ why, heard }),
    );
  });
}

function first(name, messageType, compression) {
  return new Promise((resolve) => {
    const topic = new Topic({ ros, name, messageType, compression });
    topic.subscribe((message) => {
      topic.unsubscribe();
      resolve(message);
    });
  });
}

const reached = await pursue(goals.near, false);
const cancelled = await pursue(goals.far, true);
const picture = await first("/camera/color/image_raw", "sensor_msgs/Image", "cbor");
const text = await first("/camera/color/image_raw", "sensor_msgs/Image", "none");
const kind = await new Promise((resolve, reject) =>
  new Service({ ros, name: "/rosapi/topic_type", serviceType: "rosapi_msgs/srv/TopicType" })
    .callService({ topic: "/odom" }, (values) => resolve(values.type), reject),
);
const topics = await new Promise((resolve, reject) => ros.getTopics(resolve, reject));
ros.close();
console.log(
  JSON.stringify({
    reached,
    cancelled,
    pixels: picture.data.length,
    same: Buffer.from(text.data, "base64").equals(Buffer.from(picture.data)),
    kind,
    topics: topics.topics,
  }),
);
